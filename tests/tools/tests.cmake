cavea_test(tools remesh io)
find_package(nlohmann_json REQUIRED)
# The program's own parts that can be tested without running it.
foreach(source IN ITEMS parameters parameters_json parameters_mmg3d staging)
  target_sources(cavea_test_tools PRIVATE ${PROJECT_SOURCE_DIR}/tools/cavea/${source}.cpp)
endforeach()
target_include_directories(cavea_test_tools PRIVATE ${PROJECT_SOURCE_DIR}/tools/cavea)
target_link_libraries(cavea_test_tools PRIVATE nlohmann_json::nlohmann_json fmt::fmt)

# README.md's program, so that it compiles and runs.
add_executable(cavea_snippet ${PROJECT_SOURCE_DIR}/docs/snippets/library.cpp)
target_link_libraries(cavea_snippet PRIVATE cavea_remesh cavea_io)

add_dependencies(cavea_test_tools cavea cavea_make_sample cavea_snippet)
target_compile_definitions(cavea_test_tools PRIVATE
  CAVEA_PROGRAM="$<TARGET_FILE:cavea>"
  CAVEA_MAKE_SAMPLE="$<TARGET_FILE:cavea_make_sample>"
  CAVEA_SNIPPET="$<TARGET_FILE:cavea_snippet>"
  CAVEA_SOURCE="${PROJECT_SOURCE_DIR}"
  CAVEA_VERSION="${PROJECT_VERSION}")
# A program without OpenVDB has no grids to try.
if(NOT (CAVEA_OPENVDB AND CAVEA_OPENVDB_LIBRARY))
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/tools/grid_test.cpp PROPERTIES HEADER_FILE_ONLY ON)
endif()
