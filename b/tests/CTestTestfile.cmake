# CMake generated Testfile for 
# Source directory: /tmp/w0/tests
# Build directory: /tmp/w0/b/tests
# 
# This file includes the relevant testing commands required for 
# testing this directory and lists subdirectories to be tested as well.
include("/tmp/w0/b/tests/cavea_test_mesh[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_io[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_partition[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_field[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_subdivide[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_surface[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_operator[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_part[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_remesh[1]_include.cmake")
include("/tmp/w0/b/tests/cavea_test_tools[1]_include.cmake")
