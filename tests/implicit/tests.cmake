cavea_test(implicit implicit remesh)
