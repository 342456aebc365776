#include "cavea/implicit/keep.h"

#include "cavea/base/error.h"
#include "cavea/base/ids.h"

namespace cavea {

void keep_tets(MeshData& data, const std::function<bool(std::size_t)>& is_kept) {
  std::vector<std::int32_t> new_id(data.tets.size(), kNone);
  std::size_t n = 0;
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    if (!is_kept(t)) continue;
    new_id[t] = std::int32_t(n);
    data.tets[n] = data.tets[t];
    data.tet_refs[n++] = data.tet_refs[t];
  }
  if (n == 0) throw InputError("nothing is left of the side of the level set that is to be kept");
  data.tets.resize(n);
  data.tet_refs.resize(n);
  for (std::int32_t& t : data.required_tets) t = new_id[t];
  std::erase(data.required_tets, kNone);
}

}  // namespace cavea
