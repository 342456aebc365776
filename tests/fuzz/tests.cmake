# Coverage-guided fuzzing of the Medit readers: with CAVEA_FUZZ the target itself; else, where
# clang++ has libFuzzer, a test that builds it with clang++ in a folder of its own, and one that
# runs it for a minute.
if(CAVEA_FUZZ)
  # The readers' own sources: the floors that writers need would take minutes with sanitizers.
  set(readers medit.cpp medit_bytes.cpp medit_text.cpp text_scan.cpp)
  list(TRANSFORM readers PREPEND ${PROJECT_SOURCE_DIR}/io/)
  add_executable(cavea_fuzz_medit ${CMAKE_CURRENT_LIST_DIR}/medit.cpp ${readers})
  target_include_directories(cavea_fuzz_medit PRIVATE
    ${CMAKE_CURRENT_SOURCE_DIR}
    $<TARGET_PROPERTY:cavea_io,INTERFACE_INCLUDE_DIRECTORIES>
    $<TARGET_PROPERTY:cavea_mesh,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(cavea_fuzz_medit PRIVATE cavea_geometry)
  target_link_options(cavea_fuzz_medit PRIVATE -fsanitize=fuzzer)
  return()
endif()

find_program(CAVEA_CLANG clang++)
# The target has its own sanitizers: under those of this build it would be run twice.
if(NOT CAVEA_CLANG OR CMAKE_CXX_FLAGS MATCHES "fsanitize")
  return()
endif()
set(fuzz_folder ${PROJECT_BINARY_DIR}/fuzz)
file(MAKE_DIRECTORY ${fuzz_folder}/found)
file(WRITE ${fuzz_folder}/probe.cpp
  "#include <cstddef>\nextern \"C\" int LLVMFuzzerTestOneInput(const unsigned char*, std::size_t) { return 0; }\n")
execute_process(
  COMMAND ${CAVEA_CLANG} -fsanitize=fuzzer,address ${fuzz_folder}/probe.cpp -o ${fuzz_folder}/probe
  RESULT_VARIABLE no_fuzzer OUTPUT_QUIET ERROR_QUIET)
if(no_fuzzer)
  message(STATUS "clang++ without libFuzzer: the Medit readers are not fuzzed")
  return()
endif()

add_test(NAME Fuzz.Builds COMMAND ${CMAKE_CTEST_COMMAND}
  --build-and-test ${PROJECT_SOURCE_DIR} ${fuzz_folder}/build --build-generator ${CMAKE_GENERATOR}
  --build-target cavea_fuzz_medit
  --build-noclean --build-options
                  -DCMAKE_BUILD_TYPE= -DCMAKE_CXX_FLAGS=-O1 -DCMAKE_CXX_COMPILER=${CAVEA_CLANG}
                  -DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER} -DCAVEA_FUZZ=ON -DCAVEA_VTK=OFF -DCAVEA_BENCH=OFF)
# New inputs go into the first folder, those that fail into fuzz_folder.
add_test(NAME Fuzz.MeditReadersForAMinute COMMAND ${fuzz_folder}/build/bin/cavea_fuzz_medit
  -max_total_time=60 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1
  -artifact_prefix=${fuzz_folder}/ ${fuzz_folder}/found ${CMAKE_CURRENT_LIST_DIR}/corpus)
set_tests_properties(Fuzz.Builds PROPERTIES LABELS fuzz FIXTURES_SETUP fuzz TIMEOUT 600)
set_tests_properties(Fuzz.MeditReadersForAMinute PROPERTIES
  LABELS fuzz FIXTURES_REQUIRED fuzz TIMEOUT 180)
