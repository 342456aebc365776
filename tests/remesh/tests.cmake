cavea_test(remesh remesh)

# In the tsan preset only: a race that must be found.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize=thread")
  add_executable(cavea_seeded_race ${CMAKE_CURRENT_LIST_DIR}/race/seeded_race.cpp)
  target_link_libraries(cavea_seeded_race PRIVATE cavea_base)
  add_test(NAME ThreadSanitizer.FindsASeededRace COMMAND cavea_seeded_race)
  set_tests_properties(ThreadSanitizer.FindsASeededRace PROPERTIES
    PASS_REGULAR_EXPRESSION "WARNING: ThreadSanitizer: data race")
endif()
