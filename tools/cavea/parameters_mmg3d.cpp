#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "cavea/base/error.h"
#include "parameters.h"

namespace cavea::program {
namespace {

struct Word {
  std::string text;
  int line = 0;
};

/// The words of a text one after the other; what goes wrong is told with the file and the line.
class Words {
 public:
  Words(const std::string& text, std::string name) : name_(std::move(name)) {
    int line = 1;
    std::string word;
    const auto end_word = [&] {
      if (!word.empty()) words_.push_back({word, line});
      word.clear();
    };
    for (const char c : text) {
      if (!std::isspace(static_cast<unsigned char>(c))) {
        word += c;
        continue;
      }
      end_word();
      line += c == '\n';
    }
    end_word();
  }

  bool at_end() const { return next_ == words_.size(); }
  const Word& take(const char* due) {
    if (at_end()) throw InputError(fmt::format("{}: ends where {} is due", name_, due));
    return words_[next_++];
  }
  /// A word in lower case: mmg's keywords have any.
  Word take_keyword(const char* due) {
    Word word = take(due);
    std::transform(word.text.begin(), word.text.end(), word.text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return word;
  }
  template <class Number>
  Number take_number(const char* due) {
    const Word& word = take(due);
    Number value{};
    const char* end = word.text.data() + word.text.size();
    const auto [stop, error] = std::from_chars(word.text.data(), end, value);
    if (error != std::errc() || stop != end)
      fail(word.line, fmt::format("{} is due, not '{}'", due, word.text));
    return value;
  }
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", name_, line, what));
  }

 private:
  std::string name_;
  std::vector<Word> words_;
  std::size_t next_ = 0;
};

LocalParameters::Entity entity_of(const Words& words, const Word& word) {
  if (word.text == "triangle" || word.text == "triangles")
    return LocalParameters::Entity::kTriangles;
  if (word.text == "tetrahedron" || word.text == "tetrahedra")
    return LocalParameters::Entity::kTets;
  words.fail(word.line, fmt::format("'{}' has no local parameters here: only triangles and "
                                    "tetrahedra do",
                                    word.text));
}

LocalParameters take_row(Words& words) {
  LocalParameters p;
  p.reference = words.take_number<std::int32_t>("a reference");
  const Word entity = words.take_keyword("Triangles or Tetrahedra");
  p.entity = entity_of(words, entity);
  p.hmin = words.take_number<double>("hmin");
  p.hmax = words.take_number<double>("hmax");
  const double hausd = words.take_number<double>("hausd");
  // Every row has one; of a tet it has no meaning.
  if (p.entity == LocalParameters::Entity::kTriangles) p.hausd = hausd;
  try {
    validate_entry(p);
  } catch (const OptionError& e) {
    words.fail(entity.line, e.what());
  }
  return p;
}

}  // namespace

Parameters parse_parameters_mmg3d(const std::string& text, const std::string& name) {
  Words words(text, name);
  const Word keyword = words.take_keyword("the keyword Parameters");
  if (keyword.text != "parameters")
    words.fail(keyword.line, fmt::format("the keyword Parameters is due, not '{}'", keyword.text));
  const auto rows = words.take_number<std::int32_t>("the number of rows");
  Parameters parameters;
  for (std::int32_t i = 0; i < rows; ++i) parameters.local.push_back(take_row(words));
  if (!words.at_end()) {
    const Word more = words.take("");
    words.fail(more.line, fmt::format("'{}' comes after the {} rows", more.text, rows));
  }
  return parameters;
}

}  // namespace cavea::program
