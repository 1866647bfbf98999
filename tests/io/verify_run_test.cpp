#include <gracilis/io/mesh/mesh_writer.hpp>
#include <gracilis/io/run/measures_table.hpp>
#include <gracilis/io/run/output_hashes.hpp>
#include <gracilis/io/run/verify_run.hpp>

#include <gracilis/geometry/measures.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <io/test_files.hpp>
#include <io/tiny_run.hpp>

using namespace gracilis;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

namespace {

/// A finished run whose measures are those of its surfaces.
class VerifyRun : public testing::Test {
 protected:
  VerifyRun() { write("complete"); }

  void write(const std::string& status) {
    RunFolder out(folder.path(), run.scene, run.poses, ExistingRun::replace);
    for (int i = 0; i < 3; ++i) {
      FrameRecord record = run.record(i);
      record.measures[0].volume_ratio = std::pow(1 + 0.1 * i, 3);
      out.write_frame(record);
    }
    out.finish();
    RunManifest manifest;
    manifest.status = status;
    out.write_manifest(manifest);
  }
  std::vector<std::string> findings() const { return verify_run(folder.path()).findings; }
  fs::path frame(int number) const { return frame_file(folder.path(), "gluteus_maximus_r", number); }

  /// As if the change had been there when the run ended.
  void seal_again() const {
    std::string manifest = content(folder.path() / "run.json");
    const std::size_t at = manifest.find("\"outputs_sha256\": \"") + 19;
    folder.write("run.json", manifest.replace(at, 64, write_output_hashes(folder.path())));
  }

  TestFolder folder;
  TinyRun run;
};

TEST_F(VerifyRun, a_run_as_it_was_written_has_no_findings) {
  const Verification result = verify_run(folder.path());
  EXPECT_THAT(result.findings, IsEmpty());
  EXPECT_EQ(result.status, "complete");
  EXPECT_EQ(result.frames, 3);
  EXPECT_EQ(result.files, 6u + 2u) << "six surfaces, measures.csv and run.pvd";
}

TEST_F(VerifyRun, the_list_is_one_that_sha256sum_checks) {
  const std::string command = "cd " + folder.path().string() + " && sha256sum --quiet --check outputs.sha256";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(VerifyRun, an_empty_file_is_one_like_others) {
  fs::create_directories(folder.path() / "plots");
  folder.write("plots/mine.txt", "");
  seal_again();
  EXPECT_THAT(findings(), IsEmpty());
  folder.write("plots/mine.txt", "more");
  EXPECT_THAT(findings(), ElementsAre("plots/mine.txt has changed"));
  folder.write("plots/mine.txt", "");
  fs::resize_file(folder.path() / "run.pvd", 0);
  EXPECT_THAT(findings(), ElementsAre("run.pvd has changed"));
}

TEST_F(VerifyRun, what_is_missing_or_has_changed_is_named) {
  std::fstream(frame(2), std::ios::in | std::ios::out | std::ios::ate | std::ios::binary) << " ";
  EXPECT_THAT(findings(), ElementsAre("frames/gluteus_maximus_r_0002.vtp has changed"));
  fs::remove(folder.path() / "run.pvd");
  EXPECT_THAT(findings(), Contains("run.pvd is missing"));
}

TEST_F(VerifyRun, a_list_that_was_changed_or_taken_away_is_seen) {
  const std::string list = content(folder.path() / "outputs.sha256");
  folder.write("outputs.sha256", list.substr(list.find('\n') + 1));
  EXPECT_THAT(findings(), ElementsAre("outputs.sha256 has changed"));
  fs::remove(folder.path() / "outputs.sha256");
  EXPECT_THAT(findings(), ElementsAre("outputs.sha256 is missing"));
}

TEST_F(VerifyRun, frames_that_run_json_does_not_tell_of_are_missed) {
  fs::remove(frame(2));
  EXPECT_THAT(findings(), Contains(HasSubstr("run.json tells of 3 frames, 2 are whole")));
}

TEST_F(VerifyRun, volumes_are_measured_again) {
  write_surface(frame(1), run.scene.muscles[0].surface.vertices * 1.2, run.scene.muscles[0].surface.faces);
  seal_again();
  EXPECT_THAT(findings(), ElementsAre(HasSubstr("gluteus_maximus_r in frame 1: measures.csv says 1.331000")));
}

TEST_F(VerifyRun, an_interrupted_run_is_compared_with_what_it_says_alone) {
  write("interrupted");
  const Verification result = verify_run(folder.path());
  EXPECT_THAT(result.findings, IsEmpty());
  EXPECT_EQ(result.files, 0u);
  EXPECT_FALSE(fs::exists(folder.path() / "outputs.sha256")) << "that of the run before is gone";
}

TEST_F(VerifyRun, a_list_that_leads_out_of_the_folder_is_refused) {
  folder.write("outputs.sha256", std::string(64, '0') + "  ../a\n");
  EXPECT_THAT(message_of_input_error([&] { read_output_hashes(folder.path()); }), HasSubstr("outputs.sha256:1: is no"));
  folder.write("outputs.sha256", std::string(64, '0') + "  /etc/passwd\n");
  EXPECT_THAT(message_of_input_error([&] { read_output_hashes(folder.path()); }), HasSubstr("outputs.sha256:1: is no"));
}

}  // namespace
