cavea_test(partition partition)
