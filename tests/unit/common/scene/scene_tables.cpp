#include "tests/unit/common/scene/scene_tables.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "common/error/error.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate::test {
namespace {

const std::string material = "[material.m]\nmass_g = 1\nk1_N_per_m = 10\n";
const std::string ball =
    "[[body]]\nname = \"b\"\nshape = \"sphere\"\nradius_mm = 5\nspacing_mm = 1\nmaterial = \"m\"\n";
const std::string hand = "[device.d]\ndriver = \"omni\"\n[device.e]\ndriver = \"omni\"\n";
const std::string least = material + ball;

/// A table of its own beside the least scene.
SceneTable table(const std::string& heading, const std::string& title, const std::string& keys = "") {
  return {heading, "", least + title + "\n", keys, ""};
}

SceneTable body(const std::string& shape, const std::string& keys) {
  // Two materials and a tool's device, so that a key can name another one.
  return {"[[body]]", shape, material + "[material.n]\nmass_g = 2\nk1_N_per_m = 10\n[[body]]\n",
          "name = \"b\"\nmaterial = \"m\"\nshape = \"" + shape + "\"\n" + keys, ""};
}

SceneTable elements() {
  const std::string tissue = "density_kg_per_m3 = 1\nmodulus_kPa = 10\n";
  return {"[[body]]", "box", "[material.m]\n" + tissue + "[material.n]\n" + tissue + "[[body]]\n",
          "name = \"b\"\nmaterial = \"m\"\nshape = \"box\"\nsize_mm = [5, 5, 5]\nspacing_mm = 1\nlattice = "
          "\"voxel\"\nmodel = \"fem\"\n",
          ""};
}

SceneTable mesh() {
  const std::string tissue = "density_kg_per_m3 = 1\nmodulus_kPa = 10\n";
  return {"[[body]]", "mesh", "[material.m]\n" + tissue + "[material.n]\n" + tissue + "[[body]]\n",
          "name = \"b\"\nmaterial = \"m\"\nshape = \"mesh\"\nfile = \"organ.msh\"\nunit = \"mm\"\n", ""};
}

SceneTable surface() {
  const std::string tissue = "density_kg_per_m3 = 1\nmodulus_kPa = 10\n";
  return {"[[body]]", "surface", "[material.m]\n" + tissue + "[material.n]\n" + tissue + "[[body]]\n",
          "name = \"b\"\nmaterial = \"m\"\nshape = \"mesh\"\nfile = \"organ.msh\"\nunit = \"mm\"\nmodel = "
          "\"surface\"\nthickness_mm = 1\n",
          ""};
}

/// Of an image that is awake in parts, which only finite elements are.
SceneTable awake_parts() {
  SceneTable all = elements();
  const auto box = all.text().find("shape");
  return {"deformable", "",
          all.text().substr(0, box) +
              "shape = \"volume\"\nfile = \"scan.h5\"\nkeep = [0, 1]\nmodel = "
              "\"fem\"\n[body.deformable]\n",
          "awake_mm = 20\n", ""};
}

SceneTable tool(const std::string& of, const std::string& keys) {
  return {"[[tool]]", of, least + hand + "[[tool]]\n", "device = \"d\"\n" + keys, ""};
}

/// A table in a body that is an image.
SceneTable in_body(const std::string& heading, const std::string& title, const std::string& of,
                   const std::string& keys) {
  const auto image = body("volume", "file = \"scan.h5\"\nkeep = [0, 1]\n");
  return {heading, of, image.text() + title + "\n", keys, ""};
}

std::vector<SceneTable> all_tables() {
  const std::string box = "box_min_mm = [0, 0, 0]\nbox_max_mm = [9, 9, 9]\n",
                    round = "center_mm = [0, 0, 0]\nradius_mm = 1\n";
  const std::string image = "keep = [0, 1]\n";
  const std::string needle = "length_mm = 50\ndiameter_mm = 9\ntheta_deg = [0, 0, 0, 45]\nspacing_mm = 1\n";
  const std::string knife = "length_mm = 50\nheight_mm = 20\nspacing_mm = 1\n";
  const std::string own = "name = \"t\"\nmaterial = \"m\"\n";
  std::vector<SceneTable> all = {
      {"The file", "", "", "", least},
      table("[scene]", "[scene]"),
      table("[physics]", "[physics]"),
      table("[floor]", "[floor]", "height_mm = 1\n"),
      table("[[wall]]", "[[wall]]", "point_mm = [0, 0, 0]\nnormal = [0, 0, 1]\n"),
      table("[contact]", "[contact]"),
      table("[render]", "[render]"),
      table("camera of [render]", "[render.camera]"),
      table("section of [render]", "[render.section]", "axis = \"x\"\nat_mm = 0\n"),
      table("[record]", "[record]"),
      table("[device.NAME]", "[device.d]",
            "driver = \"simulated\"\nwaypoints = [[0, 0, 0, 0], [1, 0, 0, 0]]\n"),
      table("[device.NAME]", "[device.d]",
            "driver = \"simulated\"\nwaypoints = [[0, 0, 0, 0], [1, 0, 0, 0]]\nmax_torque_N_m = 1\n"),
      body("sphere", "radius_mm = 5\nspacing_mm = 1\n"),
      body("box", "size_mm = [5, 5, 5]\nspacing_mm = 1\n"),
      elements(),
      mesh(),
      surface(),
      body("tube", "outer_radius_mm = 60\nlength_mm = 9\nspacing_mm = 1\n"),
      body("knife", knife),
      body("needle", needle),
      body("volume", "file = \"scan.h5\"\n" + image),
      body("volume", "file = \"scan.h5\"\nlattice = \"fcc\"\nspacing_mm = 1\n" + image),
      body("slices", "files = \"scan.h5\"\npixel_mm = [1, 1]\nplane_mm = 1\n" + image),
      {"a box of fixed", "", least + "fixed = [{ ", "min_mm = [0, 0, 0]\nmax_mm = [9, 9, 9]\n", "}]\n"},
      in_body("deformable", "[body.deformable]", "", "center_voxel = [1, 1, 1]\n"),
      in_body("deformable", "[body.deformable]", "", "center = \"gravity\"\n"),
      awake_parts(),
      in_body("regions", "[[body.regions]]", "", "material = \"n\"\n" + box),
      in_body("regions", "[[body.regions]]", "", "material = \"n\"\n" + round),
      in_body("regions", "[[body.regions]]", "", "material = \"n\"\nintensity = [0, 1]\n"),
      {"regions", "", mesh().text() + "[[body.regions]]\n", "material = \"n\"\ngroup = 1\n", ""},
      in_body("[[body.cavity]]", "[[body.cavity]]", "", box),
      in_body("[[body.cavity]]", "[[body.cavity]]", "", round),
      {"[[connection]]", "",
       least + "[[body]]\nname = \"another\"\nshape = \"sphere\"\nradius_mm = 5\nspacing_mm = 1\nmaterial = "
               "\"m\"\n[[body]]\nname = "
               "\"n\"\nshape = \"sphere\"\nradius_mm = 5\nspacing_mm = 1\nmaterial = \"m\"\n[[connection]]\n",
       "name = \"c\"\nfrom = \"b\"\nto = \"n\"\nwithin_mm = 3\nmodulus_kPa = 5\n", ""},
      tool("point", "name = \"t\"\n"),
      tool("stick", "name = \"t\"\nshape = \"stick\"\nlength_mm = 99\n"),
      tool("cylinder", "name = \"t\"\nshape = \"cylinder\"\nlength_mm = 9\n"),
      tool("cone", "name = \"t\"\nshape = \"cone\"\nlength_mm = 9\n"),
      tool("scalpel", "name = \"t\"\nshape = \"scalpel\"\nlength_mm = 9\n"),
      tool("scissors", "name = \"t\"\nshape = \"scissors\"\nlength_mm = 40\n"),
      tool("forceps", "name = \"t\"\nshape = \"forceps\"\n"),
      tool("rigid needle",
           "name = \"t\"\nshape = \"needle\"\nrigid = true\nlength_mm = 9\ndiameter_mm = 1\n"),
      tool("box", "name = \"t\"\nshape = \"box\"\nsize_mm = [9, 9, 9]\n"),
      tool("body", "name = \"t\"\nbody = \"b\"\n"),
      tool("knife", own + "shape = \"knife\"\n" + knife),
      tool("needle", own + "shape = \"needle\"\n" + needle),
  };
  const std::string heading = "[material.NAME]", rest = ball;
  for (const auto* mass : {"mass_g = 1\n", "density_kg_per_m3 = 1000\n"})
    for (const auto* stiffness : {"k1_N_per_m = 10\n", "modulus_kPa = 10\n", "lambda_N = 1\n"})
      all.push_back({heading, "", "[material.m]\n", std::string(mass) + stiffness, rest});
  all.push_back({heading, "", "[material.m]\n", "mass_g = 1\nk1_N_per_m = 1\nviscosity_Pa_s = 1\n", rest});
  all.push_back({heading, "", "[material.m]\n",
                 "density_kg_per_m3 = 1\nmodulus_by_intensity = [[0, 1], [1, 2]]\n",
                 "[[body]]\nname = \"b\"\nmaterial = \"m\"\nshape = \"volume\"\nfile = \"scan.h5\"\nmodel = "
                 "\"fem\"\n" +
                     image});
  all.push_back({heading, "", "[material.m]\n", "density_kg_per_m3 = 1\nmodulus_kPa = 10\nlaw = \"green\"\n",
                 rest + "lattice = \"voxel\"\nmodel = \"fem\"\n"});
  all.push_back({heading, "", "[material.m]\n",
                 "density_kg_per_m3 = 1\nmodulus_kPa = 10\nrelaxation = [[0.5, 1]]\n",
                 rest + "lattice = \"voxel\"\nmodel = \"fem\"\n"});
  all.push_back({heading, "", "[material.m]\n",
                 "density_kg_per_m3 = 1\nmodulus_kPa = 10\nbreak_ratio = 2\nfracture_energy_J_per_m2 = 1\n",
                 rest + "lattice = \"voxel\"\nmodel = \"fem\"\n"});
  all.push_back({heading, "", "[material.m]\n",
                 "density_kg_per_m3 = 1\nmodulus_kPa = 10\ncut_toughness_J_per_m2 = 9\npuncture_ratio = 2\n",
                 rest + "lattice = \"voxel\"\nmodel = \"fem\"\n"});
  all.push_back({heading, "", "[material.m]\n",
                 "density_kg_per_m3 = 1\nmodulus_kPa = 10\nyield_ratio = 1.1\nk2_ratio = 0.5\n",
                 rest + "lattice = \"voxel\"\nmodel = \"fem\"\n"});
  all.push_back({heading, "", "[material.m]\n",
                 "mass_g = 1\nk1_N_per_m = 1\nyield_ratio = 1.1\nbreak_ratio = 3\n", rest});
  for (auto& one : all) {
    if (one.heading == "[[tool]]" && one.of == "body")
      one.before.insert(one.before.find("[device"), "handle = [\"+z\"]\n");
    if (one.heading == "[[tool]]" && (one.of == "knife" || one.of == "needle")) one.also = "[[body]]";
    if (one.heading == "[device.NAME]") one.of = "simulated";
    if (one.heading != "a box of fixed") continue;
    one.keys = "min_mm = [0, 0, 0],\nmax_mm = [9, 9, 9],\n";  // an inline table: one line for the parser
  }
  return all;
}

/// Lines of an inline table stand on one line.
std::string laid_out(const SceneTable& table) {
  if (table.before.empty() || table.before.back() != ' ') return table.text();
  std::string keys = table.keys;
  std::replace(keys.begin(), keys.end(), '\n', ' ');
  while (!keys.empty() && (keys.back() == ' ' || keys.back() == ',')) keys.pop_back();
  return table.before + keys + " " + table.after;
}

}  // namespace

SceneTable SceneTable::without(const std::string& key) const {
  SceneTable changed = *this;
  changed.keys.clear();
  std::istringstream lines(keys);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(key + " =")) changed.keys += line + "\n";
  return changed;
}

SceneTable SceneTable::with(const std::string& key, const std::string& value) const {
  SceneTable changed = without(key);
  changed.keys += key + " = " + value + (before.ends_with(" ") ? ",\n" : "\n");
  return changed;
}

const std::vector<SceneTable>& scene_tables() {
  static const auto all = all_tables();
  return all;
}

std::vector<std::string> complaints_of(const SceneTable& table) {
  auto lines = complaints_about(laid_out(table));
  for (auto& line : lines) line = std::regex_replace(line, std::regex("^s\\.toml:[0-9]+:[0-9]+: "), "");
  return lines;
}

std::optional<Scene> scene_of_table(const SceneTable& table) {
  try {
    auto scene = parse_scene(laid_out(table), scene_folder() + "/s.toml");
    scene.checksum = 0;
    return scene;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::vector<std::string> known_keys(const SceneTable& table) {
  const std::string nobody = "zzzzzzzzzzzz", noun = "known keys: ";
  std::vector<std::string> keys;
  for (const auto& line : complaints_of(table.with(nobody, "1"))) {
    auto at = line.find(noun);
    if (!line.starts_with("unknown key \"" + nobody + "\"") || at == line.npos) continue;
    for (at = line.find('"', at); at != line.npos; at = line.find('"', at)) {
      const auto end = line.find('"', at + 1);
      if (end == line.npos) return {};  // the list has been cut short
      keys.push_back(line.substr(at + 1, end - at - 1));
      at = end + 1;
    }
  }
  return keys;
}

std::string expected_value(const SceneTable& table, const std::string& key) {
  const std::string none = "1979-05-27";  // no key takes a date
  const auto heard = [&](const std::string& value) -> std::string {
    for (const auto& line : complaints_of(table.with(key, value))) {
      const auto at = line.find("; write ");
      if (line.starts_with("\"" + key + "\" in ") && at != line.npos) return line.substr(at + 8);
    }
    return "";
  };
  const auto whole = heard(none);
  if (whole.empty() && table.before.empty()) {  // a key of the file whose tables stand there already
    auto alone = table;
    alone.after.clear();
    return table.after.empty() ? "" : expected_value(alone, key);
  }
  if (!whole.starts_with("[") || !whole.ends_with("]")) return whole;
  std::string list = none;
  for (auto i = std::count(whole.begin(), whole.end(), ','); i > 0; --i) list += ", " + none;
  return whole + ", each " + heard("[" + list + "]");
}

}  // namespace palpate::test
