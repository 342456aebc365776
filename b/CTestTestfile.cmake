# CMake generated Testfile for 
# Source directory: /tmp/w0
# Build directory: /tmp/w0/b
# 
# This file includes the relevant testing commands required for 
# testing this directory and lists subdirectories to be tested as well.
subdirs("engine")
subdirs("partition")
subdirs("io")
subdirs("tools")
subdirs("tests")
