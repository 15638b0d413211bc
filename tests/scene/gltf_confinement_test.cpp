// A scene reads files of its own folder and no others, however it spells them.
#include <sys/stat.h>

#include "gltf_text.hpp"
#include "gnomon/scene/image.hpp"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

// kTriangle's 36 bytes as a file, and a scene that wants them from `uri`.
std::string triangle_bytes() {
  return {reinterpret_cast<const char*>(kTriangle.data()), kTriangle.size() * sizeof(float)};
}
std::string scene_with_buffer(const std::string& uri) {
  json document = one_triangle().document;
  document["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
  return document.dump();
}

class Confinement : public ::testing::Test {
 protected:
  // outside/secret.bin beside scene/, which holds the scene and an innocent file.
  Confinement() {
    folder_.write("outside/secret.bin", triangle_bytes());
    folder_.write("scene/inside.bin", triangle_bytes());
    folder_.write("scene/sub/with space.bin", triangle_bytes());
  }
  std::string refusal(const std::string& uri) {
    try {
      (void)load_gltf(folder_.write("scene/scene.gltf", scene_with_buffer(uri)));
      return "";
    } catch (const SceneError& e) {
      return e.what();
    }
  }
  WrittenFolder folder_;
};

TEST_F(Confinement, files_of_the_own_folder_are_read) {
  EXPECT_EQ(refusal("inside.bin"), "");
  EXPECT_EQ(refusal("./inside.bin"), "");
  EXPECT_EQ(refusal("sub/with%20space.bin"), "");
  EXPECT_EQ(refusal("sub/with space.bin"), "");
  EXPECT_EQ(refusal("sub\\with space.bin"), "");
}

TEST_F(Confinement, no_spelling_of_the_parent_folder_leads_out) {
  for (const char* uri : {"../outside/secret.bin", "sub/../../outside/secret.bin",
                          "%2e%2e/outside/secret.bin", "..%2foutside%2fsecret.bin", "..\\outside\\secret.bin",
                          "./../outside/secret.bin", "sub/..%5c..\\outside/secret.bin"}) {
    const std::string message = refusal(uri);
    EXPECT_NE(message.find("buffers[0]"), std::string::npos) << uri << ": " << message;
    EXPECT_NE(message.find("leads out"), std::string::npos) << uri << ": " << message;
  }
}

TEST_F(Confinement, absolute_paths_and_schemes_are_refused) {
  const std::string secret = (folder_.path() / "outside/secret.bin").string();
  for (const std::string& uri :
       {secret, "file://" + secret, "FILE:" + secret, std::string("http://localhost/a.bin"),
        "%2f" + secret.substr(1), std::string("\\etc\\passwd"), std::string("c:/a.bin"),
        std::string("file%3a///etc/passwd")}) {
    const std::string message = refusal(uri);
    EXPECT_NE(message.find("buffers[0]: URI"), std::string::npos) << uri << ": " << message;
  }
}

TEST_F(Confinement, a_link_out_of_the_folder_is_refused_and_one_within_it_is_followed) {
  fs::create_symlink("../outside/secret.bin", folder_.path() / "scene/out.bin");
  fs::create_directory_symlink("../outside", folder_.path() / "scene/door");
  fs::create_symlink("inside.bin", folder_.path() / "scene/in.bin");
  EXPECT_NE(refusal("out.bin").find("link out of"), std::string::npos);
  EXPECT_NE(refusal("door/secret.bin").find("link out of"), std::string::npos);
  EXPECT_EQ(refusal("in.bin"), "");
}

TEST_F(Confinement, a_folder_whose_name_begins_alike_is_another_folder) {
  folder_.write("scene_other/secret.bin", triangle_bytes());
  fs::create_symlink("../scene_other/secret.bin", folder_.path() / "scene/alike.bin");
  EXPECT_NE(refusal("alike.bin").find("link out of"), std::string::npos);
}

TEST_F(Confinement, only_regular_files_are_read_and_pipes_are_not_waited_for) {
  ASSERT_EQ(::mkfifo((folder_.path() / "scene/pipe").c_str(), 0600), 0);
  // Nobody writes into it: who waited for that would not come back.
  EXPECT_NE(refusal("pipe").find("not a regular file"), std::string::npos);
  EXPECT_NE(refusal("sub").find("not a regular file"), std::string::npos);
  EXPECT_NE(refusal("nothing.bin").find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal("%00inside.bin").find("zero byte"), std::string::npos);
}

TEST_F(Confinement, the_scene_itself_must_be_a_regular_file) {
  EXPECT_THROW((void)load_gltf("/dev/zero"), SceneError);
  EXPECT_THROW((void)load_gltf(folder_.path()), SceneError);
  EXPECT_THROW((void)load_gltf(folder_.path() / "none.gltf"), SceneError);
}

TEST_F(Confinement, files_above_the_limits_are_refused_one_by_one_and_together) {
  LoadLimits limits;
  limits.file_bytes = 35;
  const fs::path scene = folder_.write("scene/scene.gltf", scene_with_buffer("inside.bin"));
  EXPECT_THROW((void)load_gltf(scene, limits), SceneError);
  limits.file_bytes = 1 << 20;
  limits.total_bytes = 35;
  EXPECT_THROW((void)load_gltf(scene, limits), SceneError);
  limits.total_bytes = 36;
  EXPECT_EQ(load_gltf(scene, limits).triangle_count(), 1u);
}

TEST_F(Confinement, what_one_file_took_is_gone_for_the_next) {
  json document = json::parse(scene_with_buffer("inside.bin"));
  document["buffers"].push_back(document["buffers"][0]);
  const fs::path scene = folder_.write("scene/scene.gltf", document.dump());
  LoadLimits limits;
  limits.total_bytes = 71;
  EXPECT_THROW((void)load_gltf(scene, limits), SceneError);
  limits.total_bytes = 72;
  EXPECT_EQ(load_gltf(scene, limits).triangle_count(), 1u);
}

TEST_F(Confinement, a_buffer_longer_than_it_says_is_cut_and_one_shorter_is_refused) {
  folder_.write("scene/long.bin", triangle_bytes() + "more");
  folder_.write("scene/short.bin", triangle_bytes().substr(1));
  EXPECT_EQ(refusal("long.bin"), "");
  EXPECT_NE(refusal("short.bin").find("buffers[0]"), std::string::npos);
}

TEST_F(Confinement, a_picture_outside_is_not_read_but_warned_of) {
  Image image;
  image.width = image.height = 1;
  image.rgba = {1, 2, 3, 255};
  write_png(image, folder_.path() / "outside/secret.png");
  write_png(image, folder_.path() / "scene/inside.png");
  for (const bool inside : {true, false}) {
    json document = json::parse(scene_with_buffer("inside.bin"));
    document["images"] = {{{"uri", inside ? "inside.png" : "../outside/secret.png"}}};
    document["textures"] = {{{"source", 0}}};
    document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    const Scene scene = load_gltf(folder_.write("scene/scene.gltf", document.dump()));
    EXPECT_EQ(scene.images.size(), inside ? 1u : 0u);
    EXPECT_EQ(scene.warnings.size(), inside ? 0u : 1u);
  }
}

TEST(ConfinementOfMemory, a_scene_from_memory_has_no_files) {
  TestGltf gltf = one_triangle();
  gltf.bytes.clear();
  gltf.document["buffers"] = {{{"byteLength", 36}, {"uri", "inside.bin"}}};
  EXPECT_NE(refusal_of(gltf).find("memory"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
