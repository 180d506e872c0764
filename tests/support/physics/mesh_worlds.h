#pragma once
// Worlds whose body is a mesh of tetrahedra: a box from a file that is written for the test.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "physics_node/mesh/tet_box.h"
#include "physics_node/mesh/write_msh.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {

/// Writes a mesh for the test that is running. @return its path
inline std::string mesh_file(const TetMesh& mesh) {
  static int n = 0;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("palpate_") + test->test_suite_name() + "_" + test->name() + "_" +
                     std::to_string(n++) + ".msh";
  std::ranges::replace(name, '/', '_');
  const std::string path = (std::filesystem::path(testing::TempDir()) / name).string();
  write_msh(path, mesh, 0.001);
  return path;
}

/// A jittered box round the origin, of soft tissue. @param cells  along x, y, z; @param edge  of a cell [m]
inline Recipe mesh_box(const std::array<int, 3>& cells, double edge,
                       const std::string& elements = "nodal_pressure", double jitter = 0.1) {
  Recipe recipe;
  recipe.lattice = "";
  recipe.shape = "shape = \"mesh\"\nunit = \"mm\"\nelements = \"" + elements + "\"\nfile = \"" +
                 mesh_file(make_tet_box({.cells = cells, .edge = edge, .jitter = jitter})) + "\"";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 10\npoisson_ratio = 0.45";
  return recipe;
}

}  // namespace palpate::physics::test
