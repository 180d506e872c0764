// Each mistake is one line at the right place that says what would be right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/unit/common/scene/sample_scene.h"

namespace palpate {
namespace {

using test::complaints_about;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// One edit of the full scene: the first `from` becomes `to`.
struct Mistake {
  std::string from, to;
  std::string place;     // "line:column" of the complaint
  std::string fragment;  // of its text
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.from << " -> " << mistake.to; }

std::string edited(const std::string& from, const std::string& to) {
  std::string text = test::full_scene;
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

class SceneMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(SceneMistakes, AreOneLineAtTheirPlace) {
  const auto& mistake = GetParam();
  const auto lines = complaints_about(edited(mistake.from, mistake.to));
  ASSERT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  EXPECT_THAT(lines[0], StartsWith("s.toml:" + mistake.place + ": "));
  EXPECT_THAT(lines[0], HasSubstr(mistake.fragment));
  EXPECT_THAT(lines[0], testing::AnyOf(HasSubstr("; "), HasSubstr("? "))) << "says what would be right";
}

INSTANTIATE_TEST_SUITE_P(
    World, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"title = \"Every key\"", "title = 3", "1:9", "\"title\" in the scene is 3; write a text in quotes"},
        {"seed = 7", "seed = -1", "2:8", "is -1; write a whole number from 0"},
        {"seed = 7", "seed = 7.0", "2:8", "write a whole number"},
        {"seed = 7", "sed = 7", "2:1", "unknown key \"sed\" in the scene; did you mean \"seed\"?"},
        {"[0, 0.5, -9.81]", "[0, -9.81]", "3:20", "is a list of 2; write [x, y, z]"},
        {"[0, 0.5, -9.81]", "[0, \"down\", -9.81]", "3:24",
         "is \"down\"; write a number from -10000 to 10000"},
        {"[0, 0.5, -9.81]", "[0, 0.5, inf]", "3:29", "is inf; write a number from -10000 to 10000"},
        {"[0, 0.5, -9.81]", "[0, 0.5, -1e300]", "3:29", "is -1e+300; write a number from -10000 to 10000"},
        {"[physics]", "[phisics]", "5:2", "unknown key \"phisics\" in the scene; did you mean \"physics\"?"},
        {"[floor]\nheight_mm = -50", "[floor]", "65:1", "[floor] lacks \"height_mm\""},
        {"enabled = false", "enabled = \"no\"", "69:11", "write true or false"},
        {"distance = \"paper\"", "distance = \"far\"", "70:12", "write \"paper\" or \"swept\""},
    }));

INSTANTIATE_TEST_SUITE_P(
    Physics, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"\"velocity_verlet\"", "\"verlet\"", "6:14",
         "write \"symplectic_euler\", \"velocity_verlet\", \"backward_euler\" or \"auto\""},
        {"step_ms = 0.25", "step_ms = 0", "7:11", "is 0; write a number above 0"},
        {"step_ms = 0.25", "step = 0.25", "7:8", "write \"auto\", or step_ms = "},
        {"step_ms = 0.25", "step = \"auto\"\nstep_ms = 1", "8:11",
         "both \"step\" and \"step_ms\" are given; keep one"},
        {"safety = 0.5", "safety = 1.5", "8:10", "write a number above 0 and at most 1"},
        {"precision = \"double\"", "precision = \"half\"", "9:13", "write \"single\" or \"double\""},
        {"threads = 2", "threads = 257", "10:11", "write a whole number from 0 to 256"},
        {"frame_Hz = 500", "frame_Hz = 5", "11:12", "write a number from 20 to 20000"},
        {"frame_Hz = 500", "frame = 500", "11:1",
         "unknown key \"frame\" in [physics]; did you mean \"frame_Hz\"?"},
    }));

INSTANTIATE_TEST_SUITE_P(
    Materials, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"density_kg_per_m3 = 1060.0", "", "13:1",
         "[material.skin] lacks \"mass_g\" or \"density_kg_per_m3\"; give exactly one"},
        {"mass_g = 2.0", "mass_g = 2.0\ndensity_kg_per_m3 = 1", "21:21",
         "both \"mass_g\" and \"density_kg_per_m3\" are given"},
        {"modulus_kPa = 20", "modulus_kPa = 20\nk1_N_per_m = 3", "15:15",
         "both \"k1_N_per_m\" and \"modulus_kPa\" are given"},
        {"k1_N_per_m = 800", "", "19:1",
         "lacks \"k1_N_per_m\", \"modulus_kPa\", \"lambda_N\" or \"modulus_by_intensity\""},
        {"modulus_kPa = 20", "modulus_kPa = -20", "15:15", "is -20; write a number above 0"},
        {"k2_ratio = 0.5", "k2_ratio = 1.01", "16:12", "write a number from 0 to 1"},
        {"viscosity_Pa_s = 150.0", "viscosity_Pa_s = 1\nviscosity_N_s_per_m = 1", "17:18",
         "keep one of them"},
        {"yield_ratio = 1.2\n", "", "23:15", "\"break_ratio\" stands alone in [material.clay]"},
        {"break_ratio = 1.5", "break_ratio = 1.1", "24:15", "write a number above yield_ratio = 1.2"},
        {"yield_ratio = 1.2", "yield_ratio = 1.0", "23:15", "write a number above 1"},
        {"[material.clay]", "[material.\"c l\"]\n[material.clay]", "19:11",
         "\"c l\" is no name for a material"},
    }));

INSTANTIATE_TEST_SUITE_P(
    Bodies, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"name = \"head\"\n", "", "26:1", "[[body]] lacks \"name\""},
        {"name = \"head\"", "name = \"my head\"", "27:8", "write a name of letters, digits"},
        {"name = \"ball\"", "name = \"head\"", "37:8", "the name \"head\" is taken"},
        {"shape = \"sphere\"", "shape = \"ball\"", "38:9",
         "write \"sphere\", \"box\", \"tube\", \"knife\", \"needle\", \"volume\", \"slices\" or \"mesh\""},
        {"shape = \"sphere\"\n", "", "36:1", "[[body]] \"ball\" lacks \"shape\""},
        {"radius_mm = 20", "radius_mm = 0", "39:13",
         "\"radius_mm\" in [[body]] \"ball\" is 0; write a number above 0"},
        {"lattice = \"fcc\"", "lattice = \"bcc\"", "40:11", "write \"fcc\" or \"voxel\""},
        {"lattice = \"fcc\"", "lattice = \"fcc\"\nmodel = \"bricks\"", "41:9",
         "write \"springs\", \"fem\" or \"surface\""},
        {"lattice = \"voxel\"", "lattice = \"voxel\"\nmodel = \"fem\"", "52:9",
         "is stepped by symplectic Euler or backward Euler; leave \"integrator\" in [physics] out, or write "
         "\"backward_euler\""},
        {"lattice = \"voxel\"", "lattice = \"voxel\"\nhourglass = \"physical\"", "52:13",
         "is of finite elements; write model = \"fem\""},
        {"modulus_kPa = 20", "modulus_kPa = 20\npoisson_ratio = 0.5", "16:17",
         "write a number from 0 to 0.495"},
        {"spacing_mm = 4\n", "", "36:1", "[[body]] \"ball\" lacks \"spacing_mm\""},
        {"material = \"clay\"", "material = \"cley\"", "42:12",
         "there is no [material.cley]; did you mean \"clay\"?"},
        {"velocity_m_per_s = [1", "velocity_m_per_s = [true", "44:21",
         "is true; write a number from -10000 to 10000"},
        {"\"-z\", {", "\"z\", {", "45:10", "is \"z\"; write \"-x\", \"+x\""},
        {"max_mm = [1, 2, 3]", "max_mm = [-5, 2, 3]", "45:50", "swap the corners of the box"},
        {"max_mm = [1, 2, 3] }", "max_mm = [1, 2, 3], max = 1 }", "45:61",
         "unknown key \"max\" in fixed of [[body]] \"ball\"; did you mean \"max_mm\"?"},
        {"size_mm = [10, 20, 30]", "size_mm = [10, 20, 0]", "50:20", "is 0; write a number above 0"},
        {"inner_radius_mm = 3", "inner_radius_mm = 5", "59:19",
         "is 5; write a number below outer_radius_mm = 5"},
        {"axis = \"x\"", "axis = 0", "61:8", "is 0; write \"x\", \"y\" or \"z\""},
    }));

INSTANTIATE_TEST_SUITE_P(
    Volumes, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"file = \"scan.h5\"", "file = \"scam.h5\"", "29:8",
         "there is no file scam.h5; make it with \"palpate import"},
        {"keep = [-200, 3071]", "keep = [3071, -200]", "30:8",
         "runs from 3071 down to -200; write [lowest, highest]"},
        {"keep = [-200, 3071]\n", "", "26:1", "lacks \"keep\""},
        {"[120, 120, 70]", "[120, 120, 0]", "31:24", "is 0; write a whole number from 1 to 4096"},
        {"{ center_voxel = [60, 20, 35], radius_voxels = 12 }", "\"some\"", "32:14",
         "write \"all\", { awake_mm = r } or { center_voxel = [i, j, k] or center"},
        {"{ center_voxel = [60, 20, 35], radius_voxels = 12 }", "{ awake_mm = 0 }", "32:27",
         "is 0; write a number above 0"},
        {"{ center_voxel = [60, 20, 35], radius_voxels = 12 }", "{ awake_mm = 20 }", "32:14",
         "but it is of springs; write model = \"fem\""},
        {"radius_voxels = 12", "radius_voxel = 12", "32:45",
         "unknown key \"radius_voxel\" in deformable of [[body]] \"head\""},
        {"keep = [", "spacing_mm = 1\nkeep = [", "30:14", "an image brings its own spacing"},
        {"keep = [", "lattice = \"fcc\"\nspacing_mm = 3\nkeep = [", "34:14",
         "on an \"fcc\" lattice all of an image deforms; leave \"deformable\" out"},
    }));

INSTANTIATE_TEST_SUITE_P(
    Tools, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"shape = \"point\"", "shape = \"rod\"", "74:9",
         "\"shape\" in [[tool]] \"tip\" is \"rod\"; write \"point\", \"stick\", \"cylinder\", \"cone\", "
         "\"box\", \"scalpel\", \"scissors\", \"forceps\", \"knife\" or \"needle\", or "
         "body = the name of a [[body]]"},
        {"shape = \"point\"", "shape = \"stick\"", "72:1",
         "[[tool]] \"tip\" lacks \"length_mm\"; give it a length"},
        {"shape = \"point\"", "shape = \"point\"\nforce_model = \"tangent\"", "75:15",
         "a point feels planes; write \"norton\""},
        {"device = \"right\"", "device = \"rihgt\"", "75:10",
         "there is no [device.rihgt]; did you mean \"right\"?"},
        {"device = \"right\"\n", "", "72:1", "[[tool]] \"tip\" lacks \"device\""},
        {"stiffness_N_per_m = 500", "stiffness_N_per_m = 0", "78:21", "write a number above 0"},
        {"[[tool]]", "[tool]", "72:1",
         "\"tool\" in the scene is a table; write each of them as a table under [[tool]]"},
    }));

INSTANTIATE_TEST_SUITE_P(
    Devices, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"driver = \"simulated\"\n", "", "81:1", "[device.right] lacks \"driver\""},
        {"rate_Hz = 1000", "rate_Hz = 1", "83:11", "write a number from 20 to 20000"},
        {"[[0, -1, 0], [1, 0, 0], [0, 0, 1]]", "[[0, -1, 0], [1, 0, 0]]", "85:12", "write three rows"},
        {"[[0, -1, 0], [1", "[[0, -2, 0], [1", "85:12", "is not orthonormal"},
        {"[0, 0, 1]]", "[0, 0, -1]]", "85:12", "mirrors; its determinant must be +1"},
        {"[1.5, 0, 0, 40]", "[0, 0, 0, 40]", "89:29", "waypoint at 0 s follows one at 0 s; times must grow"},
        {", [1.5, 0, 0, 40]", "", "89:13", "write two waypoints or more"},
        {"[1.5, 0, 0, 40]", "[1.5, 0, 0]", "89:29", "is a list of 3; write [t_s, x_mm, y_mm, z_mm]"},
        {"waypoints = [[0, 0, 0, 50], [1.5, 0, 0, 40]]\n", "", "81:1", "lacks \"waypoints\""},
        {"hand = \"pinch\"", "hand = \"foot\"", "90:8", "write \"rigid\", \"arm\", \"pinch\" or \"firm\""},
        {"hand = \"pinch\"", "model = \"phantom\"", "90:9",
         "write \"plain\", \"touch\", \"premium\" or \"omega\""},
        {"hand = \"pinch\"", "attitudes_deg = [[0, 0, 0, 0], [0, 9, 0, 0]]", "90:32",
         "attitude at 0 s follows one at 0 s; times must grow"},
        {"hand = \"pinch\"", "attitudes_deg = [[0, 0, 0]]", "90:18",
         "write [t_s, about z, about y, about x]"},
        {"hand = \"pinch\"", "pressed_s = [[1, 1]]", "90:13",
         "a span from 1 to 1 s has no length; write [from_s, to_s]"},
        {"hand = \"pinch\"", "max_torque_N_m = 0", "90:18", "write a number above 0"},
        {"hand = \"pinch\"", "turn_friction_N_m = 0.1", "90:21",
         "is of a hand that turns; give attitudes_deg or max_torque_N_m, too"},
        {"hand = \"pinch\"", "port = 3", "90:1", "unknown key \"port\" in [device.right]"},
        {"port = 3", "port = [3]", "95:8", "write a text, a number, true or false"},
    }));

INSTANTIATE_TEST_SUITE_P(
    Views, SceneMistakes,
    testing::ValuesIn(std::vector<Mistake>{
        {"size_px = [640, 480]", "size_px = [640, 0]", "100:17", "write a whole number from 16 to 8192"},
        {"pitch_deg = 30", "pitch_deg = 91", "101:38",
         "\"pitch_deg\" in camera of [render] is 91; write a number from -90 to 90"},
        {"threshold = 226", "threshold = \"bone\"", "102:13", "write a finite number"},
        {"\"wire\"", "\"wires\"", "103:18",
         "write \"tool\", \"force\", \"panels\", \"wire\", \"fragments\", "
         "\"displacement\", \"strain\", \"stress\", \"pressure\" or \"awake\""},
        {"most_frames = 50", "most_frames = 1", "105:15", "write a whole number from 2 to 1000000"},
        {"most_frames_MB = 20", "most_frames_MB = nan", "106:18", "write a number from 1 to 1000000"},
        {"inside = 300", "inside = inf", "107:10", "write a finite number"},
        {"opacity = 0.4", "opacity = 0", "108:11", "write a number from 0.05 to 1"},
        {"radius_mm = 20\n", "radius_mm = 1e300\n", "39:13",
         "is 1e+300; write a number above 0 and at most 1000000"},
        {"radius_mm = 20\n", "radius_mm = 1e-300\n", "39:13",
         "is 1e-300; write a number above 0 and at most 1000000, of 1e-12 to"},
        {"modulus_kPa = 20", "modulus_kPa = 1e13", "15:15", "of 1e-12 to 1e+12 in size"},
        {"name = \"slab\"", "name = \"\"", "48:8", "\"name\" in [[body]] is \"\"; write a name"},
        {"[1.5, 0, 0, 40]", "[1e7, 0, 0, 40]", "89:29", "each at most 1e6"},
        {"seconds = 12.5", "seconds = 0", "115:11", "is 0; write a number above 0 and at most 1000000"},
        {"seconds = 12.5", "seconds = nan", "115:11", "is nan; write a number above 0 and at most 1000000"},
        {"seconds = 12.5", "second = 1", "115:1",
         "unknown key \"second\" in [scene]; did you mean \"seconds\"?"},
        {"what = [\"positions\"]", "what = \"positions\"", "111:8",
         "write a list of \"positions\", \"forces\" and \"energy\""},
    }));

INSTANTIATE_TEST_SUITE_P(Syntax, SceneMistakes,
                         testing::ValuesIn(std::vector<Mistake>{
                             {"seed = 7", "seed =", "2:7", "; correct this first"},
                             {"seed = 7", "seed = 7\nseed = 8", "3:8",
                              "cannot redefine existing integer 'seed'; write each key once"},
                             {"[physics]", "[physics", "5:9", "; correct this first"},
                             {"\"Every key\"", "\"Every key", "1:19", "; correct this first"},
                             {"Every key", "Every \xff key", "1:15",
                              "invalid utf-8 sequence; correct this first"},
                             {"[floor]", "[physics]", "65:1", "; write each key once"},
                         }));

TEST(SceneReader, ReportsAllMistakesAtOnceInOrder) {
  const auto lines = complaints_about(R"([physics]
threads = "two"
thread = 2
[material.a]
mass_g = 0
k1_N_per_m = 10
[[body]]
name = "b"
shape = "sphere"
radius_m = 5
spacing_mm = 1
material = "c"
[colour]
)");
  EXPECT_THAT(lines, ElementsAre(StartsWith("s.toml:13:2: unknown key \"colour\""),
                                 StartsWith("s.toml:3:1: unknown key \"thread\""),
                                 StartsWith("s.toml:2:11: \"threads\" in [physics] is \"two\""),
                                 StartsWith("s.toml:5:10: \"mass_g\" in [material.a] is 0"),
                                 StartsWith("s.toml:10:1: unknown key \"radius_m\""),
                                 StartsWith("s.toml:7:1: [[body]] \"b\" lacks \"radius_mm\""),
                                 StartsWith("s.toml:12:12: there is no [material.c]")));
}

TEST(SceneReader, RefusesAWorldWithoutBodies) {
  EXPECT_THAT(complaints_about(""),
              ElementsAre(StartsWith("s.toml:1:1: the scene has no body; add a [[body]]")));
  EXPECT_THAT(complaints_about("body = []"), ElementsAre(HasSubstr("the scene has no body")));
}

TEST(SceneReader, CountsBodiesAndTools) {
  std::string text = "[material.a]\nmass_g = 1\nk1_N_per_m = 1\n[device.d]\ndriver = \"other\"\n";
  for (int i = 0; i < 9; ++i) text += "[[tool]]\nname = \"t" + std::to_string(i) + "\"\ndevice = \"d\"\n";
  for (int i = 0; i < 66; ++i)
    text += "[[body]]\nname = \"b" + std::to_string(i) +
            "\"\nshape = \"sphere\"\nradius_mm = 1\nspacing_mm = 1\nmaterial = \"a\"\n";
  EXPECT_THAT(complaints_about(text), ElementsAre(StartsWith("s.toml:30:1: too many [[tool]]; at most 8"),
                                                  StartsWith("s.toml:417:1: too many [[body]]; at most 64")));
}

std::string load_complaint(const std::string& path) {
  try {
    load_scene(path);
  } catch (const InputError& error) {
    return error.complaints().size() == 1 ? error.complaints()[0] : "several";
  }
  return "none";
}

TEST(SceneReader, LoadsAFile) {
  const auto path = test::scene_folder() + "/right.toml";
  std::ofstream(path) << test::full_scene;
  const auto scene = load_scene(path);
  EXPECT_EQ(scene.path, path);
  EXPECT_EQ(scene.bodies.size(), 4u);
}

TEST(SceneReader, RefusesATitleThatNoRecordHasRoomFor) {
  const auto complaints = [](std::size_t n) {
    try {
      parse_scene("title = \"" + std::string(n, 'x') + "\"\n", "s.toml");
    } catch (const InputError& error) {
      return error.complaints();
    }
    return std::vector<std::string>();
  };
  const auto about_title =
      testing::Contains(testing::StartsWith("s.toml:1:9: \"title\" has 1001 bytes; at most 1000 "));
  EXPECT_THAT(complaints(1001), about_title);
  EXPECT_THAT(complaints(1000), testing::Not(testing::Contains(HasSubstr("title"))));
}

TEST(SceneReader, RefusesWhatIsNoSceneFile) {
  const auto folder = test::scene_folder();
  EXPECT_EQ(load_complaint(folder + "/none.toml"),
            folder + "/none.toml: no such file; give the path of a scene file (TOML)");
  EXPECT_THAT(load_complaint(folder), HasSubstr(": not a file; give the path of a scene file"));
  ASSERT_EQ(mkfifo((folder + "/pipe").c_str(), 0600), 0);
  EXPECT_THAT(load_complaint(folder + "/pipe"), HasSubstr(": not a file;"));
  std::ofstream(folder + "/large.toml") << std::string(1024 * 1024, '#');
  EXPECT_THAT(load_complaint(folder + "/large.toml"), HasSubstr(": too large for a scene;"));
}

TEST(SceneReader, SurvivesDeepNesting) {
  EXPECT_EQ(complaints_about("a = " + std::string(20000, '[')).size(), 1u);
  std::string path = "a", braces = "a = ";
  for (int i = 0; i < 20000; ++i) path += ".a";
  for (int i = 0; i < 20000; ++i) braces += "{a.b.c = ";
  EXPECT_THAT(complaints_about(path + " = 1"), ElementsAre(HasSubstr("a key of too many parts")));
  EXPECT_THAT(complaints_about("[" + path + "]"), ElementsAre(HasSubstr("a key of too many parts")));
  EXPECT_EQ(complaints_about(braces).size(), 1u);
  EXPECT_THAT(complaints_about("# " + std::string(500, '.') + "\n" + test::full_scene), IsEmpty());
}

TEST(SceneReader, RefusesWhatTheParserIsAtALossWith) {
  EXPECT_THAT(complaints_about("a = 1\n[=]\n"),
              ElementsAre(StartsWith("s.toml:2:2: a name, key or value is missing")));
  EXPECT_THAT(complaints_about("t = \"\u00e9\"\nb = [}]\n"),
              ElementsAre(StartsWith("s.toml:2:6: a name, key or value is missing")));
  EXPECT_THAT(complaints_about("t = 1 \u00e9\n"), ElementsAre(StartsWith("s.toml:1:7: ")));
}

TEST(SceneReader, KeepsComplaintsOnOneLine) {
  for (const auto& line : complaints_about("\"a\\nb\" = 1\ntitle = [\"x\\n\"]\n"))
    EXPECT_EQ(line.find('\n'), line.npos);
  EXPECT_EQ(
      complaints_about("\"a\\nb\" = 1\n").at(0),
      "s.toml:1:1: unknown key \"a b\" in the scene; known keys: \"title\", \"seed\", \"gravity_m_per_s2\", "
      "\"scene\", \"physics\", \"material\", \"device\", \"body\", \"connection\", \"tool\", \"floor\", "
      "\"wall\", "
      "\"contact\", \"render\" and \"record\"");
}

}  // namespace
}  // namespace palpate
