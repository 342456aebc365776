cavea_test(io io mesh)
# What the fuzz target is made of is tested on its own, too.
target_sources(cavea_test_io PRIVATE fuzz/medit.cpp)
target_compile_definitions(cavea_test_io PRIVATE
  CAVEA_FUZZ_CORPUS="${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus")
if(CAVEA_VTK)
  find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel IOXML)
  if(VTK_FOUND)
    target_compile_definitions(cavea_test_io PRIVATE CAVEA_HAVE_VTK)
    target_link_libraries(cavea_test_io PRIVATE VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
  endif()
endif()
