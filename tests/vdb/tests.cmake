# The odd grids that are to be refused are made with OpenVDB itself.
if(CAVEA_OPENVDB AND CAVEA_OPENVDB_LIBRARY)
  cavea_test(vdb vdb io)
  target_include_directories(cavea_test_vdb SYSTEM PRIVATE ${CAVEA_OPENVDB_INCLUDE_DIR})
  target_link_libraries(cavea_test_vdb PRIVATE ${CAVEA_OPENVDB_LIBRARY} ${CAVEA_IMATH_LIBRARY} TBB::tbb)
endif()
