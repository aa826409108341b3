// Wrong usage and unusable input: status 2, nothing on standard output, one line that names the culprit.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <ostream>

#include "cli/build_failure.h"
#include "run_whittle.h"

namespace whittle::test {
namespace {

struct Mistake {
  const char* name;
  std::vector<std::string> args;
  std::vector<std::string> mentions;  ///< the culprit and the way out
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class Usage : public testing::TestWithParam<Mistake> {};

TEST_P(Usage, IsStatusTwoAndOneLineThatNamesTheCulprit) {
  const Folder folder;  // nothing may be written to it
  const Outcome run = runWhittle(GetParam().args, {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_EQ(run.err.rfind("whittle: ", 0), 0U) << run.err;
  for (const auto& word : GetParam().mentions)
    EXPECT_NE(run.err.find(word), std::string::npos) << "no '" << word << "' in: " << run.err;
  EXPECT_TRUE(folder.names().empty());
}

std::vector<Mistake> mistakes() {
  const std::string s = scene();
  return {
      {"UnknownCommand", {"rendr", s}, {"rendr", "'render'", "whittle --help"}},
      {"OptionBeforeCommand", {"--quiet", "render", s}, {"--quiet", "command comes first"}},
      {"UnknownOption", {"render", s, "--widht", "3"}, {"--widht", "'--width'", "whittle render --help"}},
      {"UnknownOptionOfInfo", {"info", s, "--frobnicate"}, {"--frobnicate", "whittle info --help"}},
      {"OneArgumentTooMany", {"render", s, "more.glb"}, {"more.glb"}},
      {"NoScene", {"render"}, {"SCENE"}},
      {"MissingFile", {"render", "nope.glb", "-o", "a.png"}, {"nope.glb"}},
      {"FolderAsScene", {"render", WHITTLE_SCENES, "-o", "a.png"}, {WHITTLE_SCENES, "folder"}},
      {"FolderAsOutput", {"render", s, "-o", "."}, {"--output", "."}},
      {"MissingOutputFolder",
       {"render", s, "-o", "nope/a.png"},
       {"--output", "nope/a.png", "does not exist"}},
      {"UnknownExtension", {"render", s, "-o", "a.gif"}, {"--output", "a.gif", ".png"}},
      {"WidthZero", {"render", s, "--width", "0"}, {"--width", "'0'", "1 to 65535"}},
      {"WidthNoNumber", {"render", s, "--width", "12px"}, {"--width", "'12px'"}},
      {"WidthMissing", {"render", s, "--width"}, {"--width", "value is missing"}},
      {"BouncesTooMany", {"render", s, "--bounces", "99999999999999999999"}, {"--bounces", "1 to 4096"}},
      {"SeedNegative", {"render", s, "--seed", "-1"}, {"--seed", "'-1'"}},
      {"ExplainOneNumber", {"render", s, "--explain", "12"}, {"--explain", "'12'", "X,Y"}},
      {"ExplainNegative", {"render", s, "--explain", "3,-1"}, {"--explain", "'-1'"}},
      {"ReferenceOfNoPixel", {"render", s, "--with-reference"}, {"--with-reference", "--explain"}},
      {"ExplainOutside", {"render", s, "--quiet", "--explain", "640,0"}, {"--explain: 640,0", "640×360"}},
      {"CropThreeNumbers", {"render", s, "--crop", "1,2,3"}, {"--crop", "'1,2,3'", "X,Y,W,H"}},
      {"CropMixed", {"render", s, "--crop", "1,2,50%,50%"}, {"--crop", "'1,2,50%,50%'", "shares"}},
      {"CropNegative", {"render", s, "--crop", "-1,2,3,4"}, {"--crop", "'-1'"}},
      {"CropShareTooLarge", {"render", s, "--crop", "0.,0.,1.5,1."}, {"--crop", "'1.5'", "0 to 1"}},
      {"CropOutside", {"render", s, "--crop", "600,0,41,1"}, {"--crop: 600,0,41,1 lies outside", "640×360"}},
      {"CropSharesOutside", {"render", s, "--crop", "60%,0%,60%,10%"}, {"--crop", "lies outside", "640×360"}},
      {"CropEmpty", {"render", s, "--crop", "5,5,0,3"}, {"--crop", "less than a pixel"}},
      {"CropOutsideToReference", {"reference", s, "-o", "a.exr", "--crop", "0,0,1,361"}, {"--crop", "360"}},
      {"PixelOutside", {"render", s, "--pixel", "640,0"}, {"640,0,1,1 lies outside", "640×360"}},
      {"ExposureNan", {"render", s, "--exposure", "nan"}, {"--exposure", "'nan'"}},
      {"RayOffsetNegative", {"render", s, "--bump", "-1"}, {"--ray-offset", "'-1'"}},
      {"CutoffNegative", {"render", s, "--cutoff", "-0.1"}, {"--cutoff", "'-0.1'", "0 to 1000"}},
      {"CutoffNanToReference", {"reference", s, "-o", "a.exr", "--cutoff", "nan"}, {"--cutoff", "'nan'"}},
      {"TimeLimitWord", {"render", s, "--time-limit", "soon"}, {"--time-limit", "'soon'"}},
      {"TargetNegativeShare",
       {"render", s, "--target-error", "-1%"},
       {"--target-error", "'-1%'", "P% of the mean"}},
      {"TargetShareOfNothing", {"render", s, "--target-error", "%"}, {"--target-error", "'%'"}},
      {"TargetPerMille", {"info", s, "--target-error", "1‰"}, {"--target-error", "'1‰'"}},
      {"TargetOfTwoShares", {"render", s, "--target-error", "1%%"}, {"--target-error", "'1%%'"}},
      {"TargetNan", {"render", s, "--target-error", "nan%"}, {"--target-error", "'nan%'"}},
      {"SamplerUnknown",
       {"render", s, "--sampler", "halton"},
       {"--sampler", "'halton'", "random|stratified|sobol"}},
      {"FlagWithValue", {"render", s, "--quiet=often"}, {"--quiet", "no value"}},
      {"CameraUnknown", {"render", s, "--camera", "nope", "-o", "a.png"}, {"--camera", "'nope'", "it has 0"}},
      {"CameraUnknownToInfo", {"info", s, "--camera", "7"}, {"--camera", "'7'", "it has 0"}},
      {"DeviceUnknown",
       {"render", s, "--device", "nope", "-o", "a.png"},
       {"--device", "'nope'", "whittle devices"}},
      {"WorkGroupTooLarge",
       {"render", s, "--work-group", "65536", "-o", "a.png"},
       {"--work-group", "at most"}},
      {"TwoLenses",
       {"info", s, "--eye", "0,1,5", "--fov", "30", "--ortho-height", "2"},
       {"--fov and --ortho-height: give one of the two"}},
      {"HeightOfTheFilesCamera",
       {"info", s, "--ortho-height", "2"},
       {"--ortho-height: needs --eye or --orbit"}},
      {"HeightZero", {"info", s, "--orbit", "0,0", "--ortho-height", "0"}, {"--ortho-height: '0'"}},
      {"AovWithoutFile", {"render", s, "--aov", "depth"}, {"--aov", "'depth'", "NAME=FILE"}},
      {"AovUnknown",
       {"render", s, "--aov", "colour=a.exr"},
       {"--aov", "colour", "depth, normal, albedo, primitive"}},
      {"AovUnknownToInfo", {"info", s, "--aov", "colour"}, {"--aov", "'colour'", "depth, normal"}},
      {"AovNotExrToInfo", {"info", s, "--aov", "depth=a.png"}, {"--aov", "a.png", ".exr"}},
      {"AdaptiveWithoutACountToInfo", {"info", s, "--adaptive"}, {"--adaptive", "--rays-per-pixel"}},
      {"AovErrorOfOneRay", {"render", s, "--aov", "error=a.exr"}, {"--aov error", "--rays-per-pixel 2"}},
      {"AovNotExr", {"render", s, "--aov", "depth=a.png"}, {"--aov", "a.png", ".exr"}},
      {"AovUnknownToReference",
       {"reference", s, "-o", "a.exr", "--aov", "normal=b.exr"},
       {"--aov", "depth, primitive"}},
      {"StatsInMissingFolder", {"render", s, "--stats", "nope/a.json"}, {"--stats", "nope/a.json"}},
      {"TraceInMissingFolder", {"render", s, "--trace", "nope/a.json"}, {"--trace", "nope/a.json"}},
      {"OneFileForTwo",
       {"render", s, "-o", "a.exr", "--aov", "depth=./a.exr"},
       {"--aov", "./a.exr", "two outputs"}},
      {"OutputIsInput", {"render", s, "--stats", s}, {"--stats", s, "input"}},
      {"TwoForStandardOutput",
       {"render", s, "--stats", "-", "--trace", "-"},
       {"--trace", "standard output", "two outputs"}},
      {"ReferenceToneMapped",
       {"render", s, "--reference", "right.PNG", "-o", "a.exr"},
       {"--reference", "right.PNG", ".exr"}},
      {"ReferenceMissing",
       {"render", s, "--reference", "nope.exr", "-o", "a.png"},
       {"--reference", "nope.exr"}},
      {"KernelsMissing", {"render", s, "--kernels", "nope", "-o", "a.png"}, {"--kernels", "nope"}},
      {"BackgroundUnreadable", {"render", s, "--background", "1,2", "-o", "a.png"}, {"--background", "1,2"}},
      {"BackgroundNegative", {"info", s, "--background=-1,0,0"}, {"--background", "-1,0,0"}},
      {"BackgroundRotationNan",
       {"render", s, "--background-rotation", "nan"},
       {"--background-rotation", "'nan'"}},
      {"BackgroundRotationNoNumber",
       {"render", s, "--background-rotation", "east"},
       {"--background-rotation: 'east' is not a number\n"}},
      {"SkyNoNumber", {"render", s, "--sky", "high,0"}, {"--sky: 'high,0' is neither none nor"}},
      {"SkyOneNumber", {"render", s, "--sky", "30"}, {"--sky: '30' is neither none nor auto"}},
      {"SkyFourNumbers", {"info", s, "--sky", "30,0,3,1"}, {"--sky", "'30,0,3,1'"}},
      {"SkyTooHazy", {"reference", s, "-o", "a.exr", "--sky", "30,0,11"}, {"--sky", "1.7 to 10"}},
      {"SkyNan", {"render", s, "--sky", "nan,0"}, {"--sky", "'nan,0'"}},
      {"SkyAndBackground",
       {"render", s, "--sky", "30,0", "--background", "1,1,1"},
       {"--background and --sky"}},
      {"BloomTooStrong", {"render", s, "--bloom", "1.1"}, {"--bloom: '1.1'", "0 to 1"}},
      {"BloomNegative", {"render", s, "--bloom=-0.1"}, {"--bloom: '-0.1'", "0 to 1"}},
      {"BloomTooWide", {"render", s, "--bloom", "0.1,5"}, {"--bloom: '0.1,5'", "0.001 to 1"}},
      {"BloomTooNarrow", {"render", s, "--bloom", "0.1,0"}, {"--bloom: '0.1,0'", "0.001 to 1"}},
      {"SkyInWords",
       {"render", s, "--sky", "noon"},
       {"--sky: 'noon' is neither none nor auto nor ELEVATION,AZIMUTH", "30,120,6"}},
      {"SkyAtNight", {"render", s, "--sky=-7,0"}, {"--sky: '-7,0'", "-6 (the end of civil twilight) to 90"}},
      {"BloomThreeNumbers", {"render", s, "--bloom", "0.1,0.1,0.1"}, {"--bloom", "1 or 2 numbers"}},
      {"AmbientNoNumber",
       {"render", s, "--ambient", "bright"},
       {"--ambient: 'bright' is neither auto nor a number from 0 to 1e+12"}},
      {"ExposureTooLarge",
       {"render", s, "--exposure", "61"},
       {"--exposure: '61' is neither auto nor a number from -60 to 60"}},
      {"BackgroundRotationInfinite",
       {"reference", s, "-o", "a.exr", "--background-rotation", "inf"},
       {"--background-rotation", "'inf'"}},
      {"BackgroundStrengthNegative",
       {"render", s, "--background-strength", "-1"},
       {"--background-strength", "'-1'", "0 to 1e+06"}},
      {"BackgroundStrengthTooLarge",
       {"info", s, "--background-strength", "1000001"},
       {"--background-strength", "0 to 1e+06"}},
      {"FeatureMistyped",
       {"info", s, "--keep-features", "Normal mpa"},
       {"--keep-features", "'Normal mpa'", "'normal map'?"}},
      {"FeatureInPart",
       {"info", s, "--keep-features", "metal,NORMAL"},
       {"'NORMAL'", "'vertex normals' or 'normal map'?"}},
      {"FeatureUnknown",
       {"info", s, "--keep-features", "frobnication"},
       {"'frobnication'; `whittle info SCENE`"}},
      {"FeatureEmpty", {"info", s, "--keep-features", ","}, {"--keep-features", "','", "empty entry"}},
      {"FeatureEmptyBetween", {"info", s, "--keep-features", "metal, ,unlit materials"}, {"empty entry"}},
      {"FeatureEmptyAtTheEnd", {"info", s, "--keep-features", "metal,"}, {"'metal,'", "empty entry"}},
      {"OutputEmpty", {"render", s, "-o", ""}, {"--output", "empty"}},
      {"StatsEmpty", {"render", s, "--stats", ""}, {"--stats", "empty"}},
      {"SceneEmpty", {"render", ""}, {"SCENE", "empty"}},
      {"OutputInAFile", {"render", s, "-o", s + "/a.png"}, {"--output", s + " is a file"}},
      {"SceneInAFile", {"info", s + "/a.glb"}, {s + "/a.glb"}},
      {"ReferenceInAFile", {"render", s, "--reference", s + "/a.exr"}, {"--reference", "Not a directory"}},
      {"CommandAfterDashes", {"--", "rendr", s}, {"rendr", "'render'"}},
      {"OptionNameAfterDashes", {"info", "--", "--json"}, {"--json: does not exist"}},
      {"SceneOfFileUnknown", {"info", s, "--scene", "nope"}, {"nope"}},
      {"CompareMissing", {"compare", "a.exr", "b.exr"}, {"a.exr"}},
      {"CompareOne", {"compare", "a.exr"}, {"B"}},
      {"ReferenceWithoutOutput", {"reference", s}, {"--output"}},
      {"JpegTooWide",
       {"render", s, "--width", "65501", "--height", "1", "-o", "a.JPG"},
       {"--output", "a.JPG", "65500"}},
      {"StrataWithoutACount",
       {"render", s, "--sampler", "stratified", "--time-limit", "1", "-o", "a.png"},
       {"--sampler", "--rays-per-pixel"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Cli, Usage, testing::ValuesIn(mistakes()),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(UsageOfFiles, APipeIsNoScene) {
  const Folder folder;
  // The opener of a pipe waits for its other end: `sleep` holds that, in case the program opens it.
  const Outcome run = runShell(
      "mkfifo scene.glb; (sleep 20 >scene.glb) & \"$WHITTLE\" render scene.glb -o a.png; s=$?; kill $!; exit "
      "$s",
      {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("scene.glb: is not a regular file"), std::string::npos) << run.err;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"scene.glb"});
}

TEST(UsageOfFiles, GarbageIsNoScene) {
  const Folder folder;
  std::ofstream(folder / "scene.glb") << "no glTF at all";
  const Outcome run = runWhittle({"render", "scene.glb"}, {folder.path(), {}});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("scene.glb"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

/// Whoever runs the tests as root can read everything: then as somebody else, where setpriv is there to ask
/// for that.
TEST(UsageOfFiles, WhatMayNotBeReadSaysSo) {
  const Folder folder;
  std::filesystem::copy_file(scene("shadow.glb"), folder / "a.glb");
  std::filesystem::permissions(folder / "a.glb", std::filesystem::perms::none);
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  const bool isRoot = ::geteuid() == 0;
  const std::string as = isRoot ? "setpriv --reuid 65534 --clear-groups " : "";
  if (isRoot && runShell(as + "\"$WHITTLE\" --version").status != 0)
    GTEST_SKIP() << "no other user to run as";
  for (const char* args : {"info a.glb", "compare a.glb a.glb", "info \"$SCENE\" --background a.glb",
                           "render \"$SCENE\" --reference a.glb --stats -"}) {
    const Outcome run = runShell(as + "\"$WHITTLE\" " + args, {folder.path(), {{"SCENE", scene()}}});
    EXPECT_EQ(run.status, 2) << args;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_NE(run.err.find("a.glb: cannot be read: Permission denied"), std::string::npos) << run.err;
  }
}

TEST(UsageOfFiles, ALinkToItselfIsReadNowhere) {
  const Folder folder;
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const std::vector<std::string>& args : {std::vector<std::string>{"info", "loop"},
                                               {"compare", "loop", "loop"},
                                               {"info", scene(), "--background", "loop"},
                                               {"render", scene(), "--reference", "loop", "-o", "a.png"}}) {
    const Outcome run = runWhittle(args, {folder.path(), {}});
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("loop: cannot be read: Too many levels of symbolic links\n"), std::string::npos)
        << run.err;
  }
}

/// A folder of kernels in which a file is missing, or no file, or does not compile.
TEST(UsageOfFiles, KernelsOfAFolderSayWhatIsWrong) {
  const Folder folder;
  const auto kernels = folder / "k", broken = kernels / "lib" / "surface" / "bsdf.cl";
  std::filesystem::copy(std::string(WHITTLE_SCENES) + "/../kernels", kernels,
                        std::filesystem::copy_options::recursive);
  const auto render = [&] {
    return runWhittle(smallRender({"-o", "a.png", "--kernels", "k"}), {folder.path(), {}});
  };
  std::ofstream(broken, std::ios::app) << "int broken(void) { return thisIsNotDeclared; }\n";
  const std::string said = render().err;
  const auto line = said.find("whittle: compiling shading (shade"), log = said.find("\n    ", line);
  ASSERT_TRUE(line != std::string::npos && log != std::string::npos) << said;
  EXPECT_NE(said.substr(line, log - line).find("thisIsNotDeclared"), std::string::npos) << said;
  EXPECT_NE(said.find("thisIsNotDeclared", log), std::string::npos) << said;
  std::filesystem::remove(broken);
  const auto expectUnreadable = [&](const char* why) {
    const Outcome run = render();
    EXPECT_EQ(run.status, 2) << "a folder without its files is wrong input";
    EXPECT_NE(run.err.find(std::string("whittle: --kernels: k/lib/surface/bsdf.cl cannot be read: ") + why),
              std::string::npos)
        << run.err;
  };
  expectUnreadable("No such file");
  std::filesystem::create_directory(broken);
  expectUnreadable("Is a directory");
}

TEST(UsageOfFiles, TheLogOfKernelsThatAreBuiltInGoesToAFile) {
  const std::string log = "a.cl:1: warning: w\na.cl:2: error: wrong\n";
  try {
    cli::explainBuildFailure(BuildError("compiling shading failed", log), {});
  } catch (const std::runtime_error& e) {
    const std::string text = e.what(),
                      start = "compiling shading failed: a.cl:2: error: wrong; the whole log is in ";
    ASSERT_EQ(text.rfind(start, 0), 0U) << text;
    EXPECT_EQ(readText(text.substr(start.size())), log);
    std::filesystem::remove(text.substr(start.size()));
  }
}

TEST(UsageOfOptions, WhatFollowsTwoDashesIsAName) {
  const Folder folder;
  std::filesystem::copy_file(scene("shadow.glb"), folder / "-odd.glb");
  for (const std::vector<std::string>& args : {std::vector<std::string>{"info", "--", "-odd.glb"},
                                               {"info", "--json", "--", "-odd.glb"},
                                               {"--", "info", "./-odd.glb"}}) {
    const Outcome run = runWhittle(args, {folder.path(), {}});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("-odd.glb"), std::string::npos) << run.out;
  }
}

TEST(UsageOfOptions, TheLastValueCounts) {
  const Folder folder;
  const Outcome run =
      runWhittle(smallRender({"--width", "16", "--stats", "s.json", "--quiet"}), {folder.path(), {}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(readJson(folder / "s.json")["settings"]["width"], 16);
}

}  // namespace
}  // namespace whittle::test
