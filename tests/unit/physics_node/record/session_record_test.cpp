// A session that was recorded can be run again, bit for bit; one whose record was damaged or cut short never lies.
#include "physics_node/record/session_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include "common/error/error.h"
#include "common/message/tissue_reset.h"
#include "common/record/hdf5_file.h"
#include "common/record/part_file.h"
#include "common/record/volume.h"
#include "common/scene/load_scene.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/record/export_vtk.h"
#include "physics_node/record/mend_record.h"
#include "physics_node/record/recorder.h"
#include "physics_node/record/replay.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/unit/physics_node/record/cut_block.h"
#include "tests/unit/physics_node/record/viewer.h"

namespace palpate::physics {
namespace {

using palpate::test::ScratchFolder;
using test::Dice;

/// Tissue that breaks under the forces of `Hand` below. Pieces that touch would take most of the time.
constexpr const char* scene_text = R"(
gravity_m_per_s2 = [0, 0, 0]
contact = { enabled = false }
[[body]]
name = "slab"
lattice = "voxel"
shape = "box"
size_mm = [24, 24, 12]
spacing_mm = 4
at_mm = [0, 0, 0]
fixed = ["-z"]
material = "tissue"
[material.tissue]
density_kg_per_m3 = 1000
modulus_kPa = 20
viscosity_Pa_s = 10
yield_ratio = 1.05
break_ratio = 1.3
[[tool]]
name = "tip"
shape = "point"
radius_mm = 4
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 50], [1, 0, 0, 50]]
[record]
what = ["positions", "forces"]
)";

/// Presses and drags, says nothing in every tenth frame, and is gone for a while.
class Hand {
 public:
  explicit Hand(std::uint64_t seed) : dice_(seed) {}
  std::optional<ToolState> next() {
    ++frame_;
    if (frame_ % 10 != 0) {
      ++state_.tick;
      state_.stamp_ns += 1'000'000;
      state_.p_WT = {dice_.between(-0.004, 0.004), dice_.between(-0.004, 0.004), 0.004};
      state_.proxy = {state_.p_WT[0], state_.p_WT[1], 0.006};
      state_.force_on_hand = {dice_.between(-2, 2), dice_.between(-2, 2), dice_.between(0, 6)};
      state_.engaged = 1;
    }
    if (frame_ > 100 && frame_ < 120) return std::nullopt;
    return state_;
  }

 private:
  Dice dice_;
  ToolState state_{};
  int frame_ = 0;
};

SceneSource write_scene(const std::string& path, const std::string& text = scene_text) {
  std::ofstream(path) << text;
  return source_of(load_scene(path), {});
}

/// Runs some frames and leaves a record in `folder`. A reset is commanded after 150 frames. @return the final hash
std::uint64_t leave_record(const ScratchFolder& folder, int frames, const std::string& text = scene_text) {
  const SceneSource source = write_scene(folder / "scene.toml", text);
  World world(load_scene(folder / "scene.toml"));
  Recorder recorder(world, source, folder.path(), Recorder::WhenBehind::wait);
  Hand hand(7);
  for (int n = 0; n < frames; ++n) {
    if (n == 150) {
      recorder.command(world, {.id = 1, .kind = CommandKind::reset});
      world.reset();
    }
    const auto state = hand.next();
    world.frame(std::span(&state, 1));
    recorder.frame(world, std::span(&state, 1));
  }
  recorder.finish(world);
  return world.state_hash();
}

struct Outcome {
  std::uint64_t frames = 0, compared = 0, hash = 0;
  std::int64_t broken = 0;
  std::optional<Replay::Difference> difference;
};

Outcome run_again(const std::string& path, int threads = 1) {
  const ScratchFolder files;
  SessionRecord record(path);
  auto laid_out = record.lay_out(files.path());
  laid_out.scene.physics->threads = threads;
  World world(laid_out.scene);
  Replay replay(record, world);
  while (replay.frame()) {
  }
  return {static_cast<std::uint64_t>(world.report().frames), replay.compared(), world.state_hash(),
          world.report().broken, replay.difference()};
}

TEST(SessionRecord, RunsAgainBitForBitOnAnyThreads) {
  const ScratchFolder folder;
  const std::uint64_t hash = leave_record(folder, 333);
  for (const int threads : {1, 2, 3}) {
    const Outcome again = run_again(folder / "record.h5", threads);
    EXPECT_FALSE(again.difference) << threads;
    EXPECT_EQ(again.frames, 333u);
    EXPECT_EQ(again.compared, 1u + 333 / frames_between_hashes + 1)
        << "the first, every twentieth and the last";
    EXPECT_EQ(again.hash, hash);
    EXPECT_GT(again.broken, 0) << "the test is about tissue that breaks";
  }
}

TEST(SessionRecord, UndoesAgainWhatWasUndone) {
  const ScratchFolder folder;
  std::uint64_t hash = 0;
  std::int64_t cut = 0;
  {
    const SceneSource source = write_scene(folder / "scene.toml", test::cut_block("lattice = \"fcc\""));
    World world(load_scene(folder / "scene.toml"));
    Recorder recorder(world, source, folder.path(), Recorder::WhenBehind::wait);
    for (int n = 0; n < 240; ++n) {
      if (n == 190) {
        cut = world.body(0).breaks();
        Command undo{.id = 1, .kind = CommandKind::reset};
        std::ranges::copy(last_stroke, undo.name.begin());
        recorder.command(world, undo);
        EXPECT_TRUE(world.undo());
      }
      const std::optional<ToolState> state = test::led_blade(n);
      world.frame(std::span(&state, 1));
      recorder.frame(world, std::span(&state, 1));
    }
    recorder.finish(world);
    hash = world.state_hash();
    EXPECT_GT(cut, 10);
    EXPECT_EQ(world.body(0).breaks(), 0);
  }
  const Outcome again = run_again(folder / "record.h5");
  EXPECT_FALSE(again.difference);
  EXPECT_EQ(again.hash, hash);
}

TEST(SessionRecord, TellsWhatHappenedToItsTissue) {
  const ScratchFolder folder;
  leave_record(folder, 333);
  const Hdf5File file(folder / "record.h5", Hdf5File::Mode::read);
  EXPECT_FALSE(file.cut_short());
  const auto breaks = file.read<std::uint64_t>("/session/breaks");
  ASSERT_GE(breaks.size(), 3u);
  EXPECT_EQ(breaks[breaks.size() - 2], static_cast<std::uint64_t>(run_again(folder / "record.h5").broken));
  EXPECT_EQ(file.read<std::uint64_t>("/session/commands"),
            (std::vector<std::uint64_t>{150, static_cast<std::uint64_t>(CommandKind::reset), 1}));
  EXPECT_EQ(file.read<std::uint64_t>("/session/flushed").back(), 333u);
  // Silence is told once when it begins and once when it ends; a state that comes again, not at all.
  const auto index = file.read<std::uint64_t>("/session/inputs/tip/index");
  EXPECT_EQ(index.size() / 7, 300u - 18 + 2) << "300 new states, 18 of them in the silence, and its two ends";
}

TEST(SessionRecord, FindsWhereAnotherInputWasGiven) {
  const ScratchFolder folder;
  leave_record(folder, 200);
  const ScratchFolder files;
  SessionRecord record(folder / "record.h5");
  World world(record.lay_out(files.path()).scene);
  world.body(0).place(world.body(0).body().lattice.masses.back(), Vec3(0, 0, 1e-12), Vec3::Zero());
  Replay replay(record, world);
  EXPECT_FALSE(replay.frame());
  ASSERT_TRUE(replay.difference());
  EXPECT_EQ(replay.difference()->frame, 0u) << "the first hash is of the state before any frame";
}

TEST(SessionRecord, HoldsTheImagesOfItsScene) {
  const ScratchFolder folder;
  Volume volume;
  volume.size = volume.source_size = {12, 10, 6};
  volume.spacing = {0.002, 0.002, 0.002};
  volume.intensity.assign(volume.n_cells(), 100.0F);
  volume.transfer = {{0, {0, 0, 0, 1}}, {200, {1, 1, 1, 1}}};
  volume.source = "made here";
  write_volume(volume, folder / "image.h5");
  std::string text = scene_text;
  const std::string box = "shape = \"box\"\nsize_mm = [24, 24, 12]\nspacing_mm = 4";
  text.replace(text.find(box), box.size(), "shape = \"volume\"\nfile = \"image.h5\"\nkeep = [50, 150]");
  const std::uint64_t hash = leave_record(folder, 60, text);
  const ScratchFolder elsewhere;
  std::filesystem::copy(folder / "record.h5", elsewhere / "copied.h5");
  for (const char* name : {"image.h5", "scene.toml", "record.h5"}) std::filesystem::remove(folder / name);
  const Outcome again = run_again(elsewhere / "copied.h5");
  EXPECT_FALSE(again.difference);
  EXPECT_EQ(again.hash, hash);
}

/// A byte that is not what it was is either named, or one that nothing depends on.
TEST(SessionRecord, NamesAFlippedByte) {
  const ScratchFolder folder;
  const std::uint64_t hash = leave_record(folder, 120);
  std::ifstream in(folder / "record.h5", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  const std::uint64_t seed = std::random_device{}();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  int named = 0;
  constexpr int flips = 300;
  for (int n = 0; n < flips; ++n) {
    std::string bytes = whole;
    const auto at = static_cast<std::size_t>(dice.between(0, static_cast<double>(bytes.size())));
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << static_cast<int>(dice.between(0, 8))));
    std::ofstream(folder / "flipped.h5", std::ios::binary) << bytes;
    try {
      const Outcome again = run_again(folder / "flipped.h5");
      EXPECT_FALSE(again.difference) << "byte " << at;
      EXPECT_EQ(again.frames, 120u) << "byte " << at;
      EXPECT_EQ(again.hash, hash) << "byte " << at;
    } catch (const InputError& error) {
      ++named;
      EXPECT_NE(std::string(error.what()).find("flipped.h5"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(named, flips / 3) << "of a file that is half empty chunks";
  // One in the middle of the hands' states is named with its rows.
  const Hdf5File file(folder / "record.h5", Hdf5File::Mode::read);
  const double first = file.read_rows<double>("/session/inputs/tip/state", 50, 1).at(16);  // of force_on_hand
  std::string bytes = whole;
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&first), sizeof first));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] ^= 1;
  std::ofstream(folder / "flipped.h5", std::ios::binary) << bytes;
  try {
    run_again(folder / "flipped.h5");
    ADD_FAILURE() << "not found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/session/inputs/tip/state, rows"), std::string::npos)
        << error.what();
  }
}

bool was_flushed(const std::string& record) {
  try {
    return Hdf5File(record, Hdf5File::Mode::read).shape("/session/flushed").at(0) > 0;
  } catch (const std::runtime_error&) {  // not there yet, or not begun
    return false;
  }
}

TEST(SessionRecord, OfAKilledWriterIsWholeUpToItsLastFlush) {
  const std::uint64_t seed = std::random_device{}();
  SCOPED_TRACE(fmt::format("seed {}", seed));
  Dice dice(seed);
  for (int trial = 0; trial < 2; ++trial) {
    const ScratchFolder folder;
    write_scene(folder / "scene.toml");
    const pid_t child = fork();
    if (child == 0) {
      leave_record(folder, 10'000'000);
      _exit(0);
    }
    while (!was_flushed(folder / "record.h5")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(dice.between(50, 1500))));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_TRUE(SessionRecord(folder / "record.h5").cut_short());
    const Outcome again = run_again(folder / "record.h5");
    EXPECT_FALSE(again.difference);
    EXPECT_GT(again.frames, 100u);
    EXPECT_GT(again.compared, again.frames / frames_between_hashes);
    EXPECT_TRUE(mend_record(folder / "record.h5"));
    EXPECT_FALSE(SessionRecord(folder / "record.h5").cut_short()) << "others can open it now";
    EXPECT_EQ(run_again(folder / "record.h5").hash, again.hash);
    EXPECT_FALSE(mend_record(folder / "record.h5"));
    const VtkExport shown =
        export_vtk(folder / "record.h5", load_scene(folder / "scene.toml"), {.folder = folder.path()});
    EXPECT_GT(shown.times, 0u);
    const auto seen = test::seen_by_vtk(shown.collection);
    ASSERT_EQ(seen.size(), shown.times);
    EXPECT_GE(seen.back()["parts"][0]["points"], 7 * 7)
        << "the tip tears much away, but not the layer that is held";
  }
}

TEST(SessionRecord, EndsWhereItsWriterFellBehind) {
  const ScratchFolder folder;
  const SceneSource source = write_scene(folder / "scene.toml");
  World world(load_scene(folder / "scene.toml"));
  Hand hand(3);
  {
    Hdf5File file(folder / "record.h5", Hdf5File::Mode::record);
    file.set_text("palpate_record", "2");
    file.set_text("commit", "none");
    SessionLog log(world, source, file);
    file.start();
    for (int n = 0; n < 12'000; ++n) {  // nobody writes meanwhile
      const auto state = hand.next();
      world.frame(std::span(&state, 1));
      log.frame(world, std::span(&state, 1));
      if (n == 11'000) log.write();  // too late: what is missing cannot come again
    }
    log.write();
    log.flush();
  }
  const Outcome again = run_again(folder / "record.h5");
  EXPECT_FALSE(again.difference);
  EXPECT_GT(again.frames, 7'000u);
  EXPECT_LT(again.frames, 11'000u);
}

}  // namespace
}  // namespace palpate::physics
