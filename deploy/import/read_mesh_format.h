#pragma once
// Meshes of tetrahedra that other programs write.

#include <string>
#include <string_view>

#include "physics_node/mesh/read_msh.h"

namespace palpate {

/// By the ending of a name: .msh (Gmsh 2.2, 4.1), .vtk (legacy VTK), .mesh (Medit); all in ASCII.
bool is_mesh_format(const std::string& path);

/// @param metres  that one unit of the file has
/// @throws InputError as physics::read_msh() does
physics::MshContent read_mesh_format(const std::string& path, double metres);

/// The same of texts. @param name  of the file, for messages
physics::MshContent parse_msh4(std::string_view text, const std::string& name, double metres);
physics::MshContent parse_vtk_mesh(std::string_view text, const std::string& name, double metres);
physics::MshContent parse_medit(std::string_view text, const std::string& name, double metres);

}  // namespace palpate
