# Laws of the tissue: motion, force, plasticity, determinism, stability.
add_library(palpate_physics_worlds STATIC ${PROJECT_SOURCE_DIR}/tests/support/physics/small_worlds.cpp
                                           ${PROJECT_SOURCE_DIR}/tests/support/physics/tool_angles.cpp)
target_link_libraries(palpate_physics_worlds PUBLIC palpate::physics)
palpate_test(NAME physics_laws_test KIND property APART
  SOURCES physics_motion_test.cpp physics_force_test.cpp physics_plastic_test.cpp physics_same_bits_test.cpp
          physics_stability_test.cpp physics_breaks_test.cpp physics_fragments_test.cpp
          physics_energy_test.cpp physics_books_test.cpp physics_sleep_test.cpp physics_construction_test.cpp
  LIBS palpate_physics_worlds)
palpate_test(NAME physics_elements_test KIND property APART SOURCES physics_elements_test.cpp physics_damper_test.cpp physics_shadow_energy_test.cpp physics_tissue_laws_test.cpp
  LIBS palpate_physics_worlds palpate_bench_problems)
# An image of which only a part is stepped.
palpate_test(NAME physics_awake_parts_test KIND property SOURCES physics_awake_parts_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_awake_cuts_test KIND property SOURCES physics_awake_cuts_test.cpp LIBS palpate_physics_worlds)
# Few stiff cells that take steps of their own.
palpate_test(NAME physics_fast_cells_test KIND property SOURCES physics_fast_cells_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_cracks_test KIND property SOURCES physics_cracks_test.cpp LIBS palpate_physics_worlds)
# Springs that a tool cuts.
palpate_test(NAME physics_cuts_test KIND property SOURCES physics_cuts_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_undo_test KIND property SANITIZERS address SOURCES physics_undo_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_parted_meshes_test KIND property SANITIZERS address SOURCES physics_parted_meshes_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_parted_cells_test KIND property SANITIZERS address SOURCES physics_parted_cells_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_failure_test KIND property SOURCES physics_failure_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_yield_test KIND property SOURCES physics_yield_test.cpp LIBS palpate_physics_worlds)
# Meshes of tetrahedra through the door of a scene: closed forms, laws, contact.
palpate_test(NAME physics_meshes_test KIND property SOURCES physics_meshes_test.cpp LIBS palpate_physics_worlds)
# Bodies that need fewer steps than others.
palpate_test(NAME physics_strides_test KIND property SOURCES physics_strides_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_parted_surfaces_test KIND property SANITIZERS address SOURCES physics_parted_surfaces_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_surfaces_test KIND property SOURCES physics_surfaces_test.cpp LIBS palpate_physics_worlds)
# Finite elements against what is known: closed forms, and CalculiX where it is installed.
palpate_test(NAME physics_solids_test KIND property APART SOURCES physics_calculix_test.cpp physics_solids_test.cpp physics_large_strain_test.cpp physics_presses_test.cpp
  LIBS palpate_physics_worlds palpate_bench_problems palpate_bench_solids)
# A rigid tip on the faces of a body: Hertz, and the laws.
palpate_test(NAME physics_touch_test KIND property SOURCES physics_touch_test.cpp LIBS palpate_physics_worlds palpate_bench_solids)
# The reference problems of palpate bench, held to the figures that the docs promise.
palpate_test(NAME physics_closed_forms_test KIND property SOURCES physics_closed_forms_test.cpp
  LIBS palpate_bench_problems)
# What becomes of a sphere that falls.
palpate_test(NAME physics_falls_test KIND property SOURCES physics_falls_test.cpp
  LIBS palpate_physics_worlds palpate_bench_falls)
target_compile_definitions(physics_falls_test PRIVATE SCENES="${PROJECT_SOURCE_DIR}/scenes")
palpate_test(NAME physics_balance_test KIND property SOURCES physics_balance_test.cpp physics_border_cells_test.cpp LIBS palpate_physics_worlds)
target_compile_definitions(physics_balance_test PRIVATE SCENES="${PROJECT_SOURCE_DIR}/scenes")
# What lies on something under backward_euler.
palpate_test(NAME physics_resting_test KIND property SOURCES physics_resting_test.cpp physics_held_tip_test.cpp LIBS palpate_physics_worlds)
# What becomes of two bodies that meet.
palpate_test(NAME physics_collide_test KIND property SOURCES physics_collide_test.cpp LIBS palpate_physics_worlds)
target_compile_definitions(physics_collide_test PRIVATE SCENES="${PROJECT_SOURCE_DIR}/scenes")
palpate_test(NAME physics_symmetry_test KIND property SOURCES physics_symmetry_test.cpp LIBS palpate_physics_worlds)
# Nothing tunnels.
palpate_test(NAME physics_stick_faces_test KIND property SOURCES physics_stick_faces_test.cpp LIBS palpate_physics_worlds)
palpate_test(NAME physics_tunnelling_test KIND property SOURCES physics_tunnelling_test.cpp
  LIBS palpate_bench_shots)
# The same bits as ever, by the widest instruction set that this machine has and by that of every x86-64 machine.
palpate_test(NAME physics_golden_test KIND golden SOURCES physics_golden_test.cpp LIBS palpate_physics_worlds)
add_test(NAME physics_golden_sse2_test COMMAND physics_golden_test WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
set_tests_properties(physics_golden_sse2_test PROPERTIES LABELS golden TIMEOUT 600
  ENVIRONMENT "PALPATE_SOURCE=${PROJECT_SOURCE_DIR};PALPATE_ISA=sse2;GTEST_OUTPUT=xml:${PROJECT_BINARY_DIR}/test_results/physics_golden_sse2_test.xml")
