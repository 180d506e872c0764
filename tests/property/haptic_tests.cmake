# Laws of the hand: stability, energy, what can never happen.
foreach(law norton fuzz)
  palpate_test(NAME haptic_${law}_test KIND property SOURCES haptic_${law}_test.cpp LIBS palpate::haptic)
  target_compile_definitions(haptic_${law}_test PRIVATE
    PALPATE_TEST_DRIVERS="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/drivers")
endforeach()
palpate_test(NAME haptic_acceptance_test KIND property SOURCES haptic_acceptance_test.cpp LIBS palpate_bench_haptic)
palpate_test(NAME haptic_copy_test KIND property SOURCES haptic_copy_test.cpp LIBS palpate_bench_haptic)
palpate_test(NAME haptic_corrupted_test KIND property SOURCES haptic_corrupted_test.cpp LIBS palpate::haptic palpate::idl)
