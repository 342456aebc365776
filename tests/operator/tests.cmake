cavea_test(operator pass field)
