// Included files: where they are looked for, what they bring, and what goes wrong.
#include <filesystem>
#include <fstream>

#include "resolved.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

namespace fs = std::filesystem;

// A folder of files that is gone at the end of the test.
class Folder {
 public:
  explicit Folder(const std::string& name) : path_(test_folder() / name) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

TEST(Include, LooksBesideTheIncludingFileThenInTheDirectories) {
  const Folder folder("order");
  folder.write("sub/a.tyn", "include \"b.tyn\"");
  folder.write("sub/b.tyn", "sphere { radius: 1 }");
  folder.write("library/b.tyn", "sphere { radius: 2 }");
  folder.write("library/c.tyn", "sphere { radius: 3 }");
  resolve::Options options;
  options.include_directories = {folder.path("library")};
  const Resolved r = resolve_text(camera_and_light + "include \"sub/a.tyn\"  include \"c.tyn\"", options,
                                  folder.path("main.tyn"));
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  ASSERT_EQ(r.scene.shapes.size(), 2u);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes[0].shape).radius, 1);
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes[1].shape).radius, 3);
}

TEST(Include, ComesOnceInAScopeHoweverItIsSpelt) {
  const Folder folder("once");
  folder.write("a.tyn", "let size = 2  sphere { radius: size }");
  folder.write("x/unused.tyn", "");
  const Resolved r = resolve_text(
      camera_and_light + "include \"a.tyn\"  include \"./x/../a.tyn\"  group { include \"a.tyn\" }", {},
      folder.path("main.tyn"));
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  EXPECT_EQ(r.scene.shapes.size(), 2u);
}

TEST(Include, StandsWhereItIsWritten) {
  const Folder folder("place");
  folder.write("a7.tyn", "sphere { radius: size }  def ball() { sphere { radius: size / 2 } }");
  const Resolved r = resolve_text(
      camera_and_light +
          "let size = 3  group { transform: translate((1, 0, 0))  include \"a{4 + size}.tyn\"  ball() }",
      {}, folder.path("main.tyn"));
  ASSERT_TRUE(r.diagnostics.all().empty()) << r.messages();
  EXPECT_EQ(r.scene.shapes.at(0).world_from_object, Transform::translate({1, 0, 0}));
  EXPECT_EQ(std::get<scene::Sphere>(r.scene.shapes.at(1).shape).radius, 1.5);
}

TEST(Include, OfTheMainFileIsACircle) {
  const Folder folder("circle");
  folder.write("a.tyn", "include \"main.tyn\"");
  folder.write("main.tyn", camera_and_light + "include \"a.tyn\"");
  const Resolved r = resolve_text(camera_and_light + "include \"a.tyn\"", {}, folder.path("main.tyn"));
  EXPECT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_NE(r.messages().find("includes itself"), std::string::npos) << r.messages();
}

TEST(Include, MessagesTellTheWay) {
  const Folder folder("way");
  folder.write("a.tyn", "include \"b.tyn\"");
  folder.write("b.tyn", "\nsphere { raduis: 1 }");
  const Resolved r = resolve_text(camera_and_light + "include \"a.tyn\"", {}, folder.path("main.tyn"));
  ASSERT_EQ(r.diagnostics.all().size(), 1u) << r.messages();
  EXPECT_EQ(r.diagnostics.all()[0].notes.size(), 2u);
  EXPECT_NE(r.messages().find("b.tyn:2:10: error"), std::string::npos) << r.messages();
}

TEST(Include, TooDeepIsAnError) {
  const Folder folder("deep");
  for (int i = 0; i < 70; ++i)
    folder.write("f" + std::to_string(i) + ".tyn", "include \"f" + std::to_string(i + 1) + ".tyn\"");
  folder.write("f70.tyn", "");
  const Resolved r = resolve_text(camera_and_light + "include \"f0.tyn\"", {}, folder.path("main.tyn"));
  ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
  EXPECT_NE(r.messages().find("more than 64 deep"), std::string::npos) << r.messages();
}

// A scene is at home in its folder and in those of --include, links followed.
TEST(Include, OfWhatLiesOutsideNeedsLeave) {
  const Folder folder("outside");
  folder.write("scene/inside.tyn", "sphere { radius: 1 }");
  folder.write("library/lamp.tyn", "sphere { radius: 2 }");
  folder.write("secret.tyn", "sphere { radius: 3 }");
  fs::create_symlink(folder.path("secret.tyn"), folder.path("scene/link.tyn"));
  fs::create_directory_symlink(folder.path("library"), folder.path("scene/books"));
  struct Case {
    std::string name;
    bool with_library, is_inside;
  };
  const Case cases[] = {{"inside.tyn", false, true},
                        {"../scene/inside.tyn", false, true},
                        {"../library/lamp.tyn", false, false},
                        {"../library/lamp.tyn", true, true},
                        {"books/lamp.tyn", false, false},
                        {"books/lamp.tyn", true, true},
                        {"lamp.tyn", true, true},
                        {"../secret.tyn", true, false},
                        {"link.tyn", true, false},
                        {folder.path("secret.tyn"), true, false},
                        {"../not_there.tyn", false, false}};
  for (const Case& c : cases)
    for (const bool allowed : {false, true}) {
      resolve::Options options;
      if (c.with_library) options.include_directories = {folder.path("library")};
      options.allow_outside = allowed;
      const Resolved r = resolve_text(camera_and_light + "include \"" + c.name + "\"", options,
                                      folder.path("scene/main.tyn"));
      const std::string messages = r.messages();
      if (c.is_inside || (allowed && c.name != "../not_there.tyn"))
        EXPECT_TRUE(messages.empty() && r.scene.shapes.size() == 1) << c.name << "\n" << messages;
      else
        EXPECT_NE(messages.find(allowed ? "no file" : "is outside of the scene's folder"), std::string::npos)
            << c.name << "\n"
            << messages;
    }
}

// Messages about it would show what is in it.
TEST(Include, OfWhatIsNoSceneShowsNothingOfIt) {
  const Folder folder("secrets");
  for (const std::string name : {"shadow", "shadow.txt", "notes.tyn.bak"}) {
    folder.write(name, "root:$6$salt$hash:19000:0:99999:7:::\nalice:password\n");
    const Resolved r =
        resolve_text(camera_and_light + "include \"" + name + "\"", {}, folder.path("main.tyn"));
    ASSERT_EQ(r.diagnostics.error_count(), 1) << r.messages();
    EXPECT_NE(r.messages().find("is not a scene"), std::string::npos) << r.messages();
    for (const char* secret : {"root", "hash", "salt", "alice", "password"})
      EXPECT_EQ(r.messages().find(secret), std::string::npos) << r.messages();
  }
  folder.write("good.inc", "sphere { radius: 1 }");
  EXPECT_EQ(resolve_text(camera_and_light + "include \"good.inc\"", {}, folder.path("main.tyn")).messages(),
            "");
}

}  // namespace UNNAMED
}  // namespace tyndall
