// OGRE's side of the sample.
#include "stage.hpp"

#include <cmath>
#include <cstring>

#include "gnomon_setup.hpp"

namespace sample {
namespace {

// OGRE's texture matrices take the world to a texture's coordinates, with depths as OpenGL's clip space has
// them.
constexpr const char* kVertex = R"(#version 120
uniform mat4 clip_from_object, map_from_object[MAPS];
uniform vec4 eye, forward;
attribute vec4 vertex;
attribute vec3 normal;
varying vec4 at[MAPS];
varying vec3 surface_normal;
varying float view_depth;
void main() {
  for (int i = 0; i < MAPS; ++i) at[i] = map_from_object[i] * vertex;
  surface_normal = normal;
  view_depth = dot(vertex.xyz - eye.xyz, forward.xyz);
  gl_Position = clip_from_object * vertex;
}
)";

// A map's depths, moved off the surface by the growth over a texel times a factor, as glPolygonOffset moves
// them.
constexpr const char* kCasterVertex = R"(#version 120
uniform mat4 clip_from_object;
attribute vec4 vertex;
void main() { gl_Position = clip_from_object * vertex; }
)";
constexpr const char* kCasterFragment = R"(#version 120
uniform float slope_factor;
void main() {
  float depth = gl_FragCoord.z;
  gl_FragColor = vec4(depth + slope_factor * max(abs(dFdx(depth)), abs(dFdy(depth))));
}
)";

// The first map whose depths hold the point; what a comparing sampler does, by hand: four texels, weighted
// bilinearly.
constexpr const char* kFragment = R"(#version 120
uniform sampler2D map0;
#if MAPS > 1
uniform sampler2D map1, map2, map3;
#endif
uniform vec4 begins, ends, biases, light;
uniform float texels;
varying vec4 at[MAPS];
varying vec3 surface_normal;
varying float view_depth;
float compare(sampler2D map, vec4 h, float bias) {
  vec3 p = h.xyz / h.w;
  if (h.w <= 0.0 || any(lessThan(p.xy, vec2(0.0))) || any(greaterThan(p.xy, vec2(1.0)))) return 1.0;
  float depth = min(0.5 * p.z + 0.5 - bias, 1.0);
  vec2 texel = p.xy * texels - 0.5, first = floor(texel), part = texel - first;
  vec4 lit;
  for (int i = 0; i < 4; ++i)
    lit[i] = depth <= texture2D(map, (first + vec2(i == 1 || i == 3 ? 1.5 : 0.5, i >= 2 ? 1.5 : 0.5)) / texels).r ? 1.0 : 0.0;
  return mix(mix(lit[0], lit[1], part.x), mix(lit[2], lit[3], part.x), part.y);
}
float lit_share() {
  if (view_depth >= begins.x && view_depth <= ends.x) return compare(map0, at[0], biases.x);
#if MAPS > 1
  if (view_depth >= begins.y && view_depth <= ends.y) return compare(map1, at[1], biases.y);
  if (view_depth >= begins.z && view_depth <= ends.z) return compare(map2, at[2], biases.z);
  if (view_depth >= begins.w && view_depth <= ends.w) return compare(map3, at[3], biases.w);
#endif
  return 1.0;
}
void main() {
  float cosine = max(-dot(normalize(surface_normal), light.xyz), 0.0);
  float lit = cosine > 0.0 ? lit_share() : 0.0;
  vec3 color = vec3(0.8, 0.77, 0.72) * (lit * cosine * vec3(1.0, 0.95, 0.85) + vec3(0.16, 0.19, 0.25) * (1.0 + 0.3 * surface_normal.y));
  gl_FragColor = vec4(pow(color, vec3(1.0 / 2.2)), lit);
}
)";

Ogre::HighLevelGpuProgramPtr program(const std::string& name, Ogre::GpuProgramType type, const char* text,
                                     std::size_t maps) {
  Ogre::HighLevelGpuProgramPtr made =
      Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, Ogre::RGN_DEFAULT, "glsl", type);
  std::string source = text;
  source.insert(source.find('\n') + 1, "#define MAPS " + std::to_string(maps) + "\n");
  made->setSource(source);
  made->load();
  return made;
}

}  // namespace

struct Stage::Singletons {
  Ogre::LogManager log;
  std::unique_ptr<Ogre::Root> root;
  Singletons() {
    log.createLog("ogre.log", true, false, true);  // the default log, neither printed nor written
    root = std::make_unique<Ogre::Root>("", "", "");
    root->loadPlugin(GNOMON_OGRE_PLUGINS "/RenderSystem_GL");
    root->setRenderSystem(root->getAvailableRenderers().at(0));
    root->initialise(false);
    const Ogre::NameValuePairList hidden{{"hidden", "true"}};
    // OGRE compiles its shadow volumes' programs with every shadow technique.
    Ogre::ResourceGroupManager::getSingleton().addResourceLocation(GNOMON_OGRE_MEDIA "/ShadowVolume",
                                                                   "FileSystem", Ogre::RGN_INTERNAL);
    root->createRenderWindow("ogre", 16, 16, false, &hidden);
    Ogre::ResourceGroupManager::getSingleton().initialiseAllResourceGroups();
  }
};

Stage::Stage(const Street& street, int width, int height)
    : singletons_(std::make_unique<Singletons>()), width_(width), height_(height) {
  scene_ = singletons_->root->createSceneManager();
  scene_->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
  scene_->setShadowTextureSelfShadow(true);
  scene_->setShadowCasterRenderBackFaces(false);
  Ogre::SceneNode* const root = scene_->getRootSceneNode();
  viewer_ = scene_->createCamera("viewer");
  eye_ = root->createChildSceneNode();
  eye_->attachObject(viewer_);
  sun_ = scene_->createLight("sun");
  sun_->setType(Ogre::Light::LT_DIRECTIONAL);
  Ogre::SceneNode* const sun = root->createChildSceneNode();
  sun->attachObject(sun_);
  sun->setDirection(ogre_from(glm::normalize(street.sun)), Ogre::Node::TS_WORLD);

  target_ = Ogre::TextureManager::getSingleton().createManual(
      "image", Ogre::RGN_DEFAULT, Ogre::TEX_TYPE_2D, static_cast<Ogre::uint>(width),
      static_cast<Ogre::uint>(height), 0, Ogre::PF_BYTE_RGBA, Ogre::TU_RENDERTARGET);
  image_ = target_->getBuffer()->getRenderTarget();
  image_->setAutoUpdated(false);
  Ogre::Viewport* const viewport = image_->addViewport(viewer_);
  viewport->setBackgroundColour(Ogre::ColourValue(0.62f, 0.74f, 0.9f));
  viewport->setOverlaysEnabled(false);

  caster_ = Ogre::MaterialManager::getSingleton().create("caster", Ogre::RGN_DEFAULT);
  Ogre::Pass* const pass = caster_->getTechnique(0)->getPass(0);
  pass->setVertexProgram(program("caster vertex", Ogre::GPT_VERTEX_PROGRAM, kCasterVertex, 1)->getName());
  pass->setFragmentProgram(
      program("caster fragment", Ogre::GPT_FRAGMENT_PROGRAM, kCasterFragment, 1)->getName());
  pass->getVertexProgramParameters()->setNamedAutoConstant(
      "clip_from_object", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  pass->setCullingMode(Ogre::CULL_NONE);
  caster_->load();
  scene_->setShadowTextureCasterMaterial(caster_);
  add_boxes(street);
}

Stage::~Stage() {
  target_.reset();
  material_.reset();
  caster_.reset();
  setup_.reset();
}

void Stage::add_boxes(const Street& street) {
  std::vector<Vertex> vertices;
  for (std::size_t i = 0; i < street.boxes.size(); ++i) {
    vertices.clear();
    append_box(street.boxes[i], vertices);
    Ogre::ManualObject* const object = scene_->createManualObject("box " + std::to_string(i));
    object->begin("BaseWhite", Ogre::RenderOperation::OT_TRIANGLE_LIST);
    for (const Vertex& vertex : vertices) {
      object->position(vertex.position.x, vertex.position.y, vertex.position.z);
      object->normal(vertex.normal.x, vertex.normal.y, vertex.normal.z);
    }
    object->end();
    scene_->getRootSceneNode()->createChildSceneNode()->attachObject(object);
    boxes_.push_back(object);
  }
}

Ogre::MaterialPtr Stage::material(std::size_t textures) {
  const std::string name = "street " + std::to_string(textures);
  if (Ogre::MaterialPtr known = Ogre::MaterialManager::getSingleton().getByName(name, Ogre::RGN_DEFAULT))
    return known;
  Ogre::MaterialPtr made = Ogre::MaterialManager::getSingleton().create(name, Ogre::RGN_DEFAULT);
  Ogre::Pass* const pass = made->getTechnique(0)->getPass(0);
  pass->setVertexProgram(program(name + " vertex", Ogre::GPT_VERTEX_PROGRAM, kVertex, textures)->getName());
  pass->setFragmentProgram(
      program(name + " fragment", Ogre::GPT_FRAGMENT_PROGRAM, kFragment, textures)->getName());
  const Ogre::GpuProgramParametersSharedPtr vertex = pass->getVertexProgramParameters();
  vertex->setNamedAutoConstant("clip_from_object", Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  const Ogre::GpuProgramParametersSharedPtr fragment = pass->getFragmentProgramParameters();
  for (std::size_t i = 0; i < textures; ++i) {
    const std::string element =
        textures == 1 ? "map_from_object" : "map_from_object[" + std::to_string(i) + "]";
    vertex->setNamedAutoConstant(element, Ogre::GpuProgramParameters::ACT_TEXTURE_WORLDVIEWPROJ_MATRIX, i);
    fragment->setNamedConstant("map" + std::to_string(i), static_cast<int>(i));
    Ogre::TextureUnitState* const unit = pass->createTextureUnitState();
    unit->setContentType(Ogre::TextureUnitState::CONTENT_SHADOW);
    unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
    unit->setTextureFiltering(Ogre::TFO_NONE);
  }
  made->load();
  return made;
}

void Stage::use(const Ogre::ShadowCameraSetupPtr& setup, std::size_t count, int texels, double slope_factor) {
  setup_ = setup;
  count_ = count;
  scene_->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, count);
  scene_->setShadowTextureSettings(static_cast<Ogre::uint16>(texels), static_cast<Ogre::uint16>(count),
                                   Ogre::PF_FLOAT32_R);
  scene_->setShadowCameraSetup(setup);
  material_ = material(count);
  for (Ogre::ManualObject* const box : boxes_) box->setMaterial(0, material_);
  caster_->getTechnique(0)->getPass(0)->getFragmentProgramParameters()->setNamedConstant(
      "slope_factor", static_cast<Ogre::Real>(slope_factor));
  material_->getTechnique(0)->getPass(0)->getFragmentProgramParameters()->setNamedConstant(
      "texels", static_cast<Ogre::Real>(texels));
}

void Stage::look(const gnomon::Camera& camera) {
  const gnomon::CameraAxes axes = gnomon::camera_axes(camera);
  eye_->setPosition(ogre_from(camera.position));
  eye_->setOrientation(Ogre::Quaternion(ogre_from(axes.right), ogre_from(axes.up), ogre_from(-axes.forward)));
  viewer_->setFOVy(Ogre::Radian(static_cast<Ogre::Real>(2.0 * std::atan(camera.top))));
  viewer_->setAspectRatio(static_cast<Ogre::Real>(camera.right / camera.top));
  viewer_->setNearClipDistance(static_cast<Ogre::Real>(camera.near_depth));
  viewer_->setFarClipDistance(static_cast<Ogre::Real>(camera.far_depth));
  scene_->setShadowFarDistance(static_cast<Ogre::Real>(camera.far_depth));
  Ogre::Pass* const pass = material_->getTechnique(0)->getPass(0);
  pass->getVertexProgramParameters()->setNamedConstant("eye",
                                                       Ogre::Vector4(ogre_from(camera.position), 1.0f));
  pass->getVertexProgramParameters()->setNamedConstant("forward",
                                                       Ogre::Vector4(ogre_from(axes.forward), 0.0f));
  pass->getFragmentProgramParameters()->setNamedConstant("light",
                                                         Ogre::Vector4(sun_->getDerivedDirection(), 0.0f));
}

Drawn Stage::draw(const std::function<MapNumbers()>& numbers_of) {
  image_->update(false);
  const MapNumbers numbers = numbers_of();
  const Ogre::GpuProgramParametersSharedPtr fragment =
      material_->getTechnique(0)->getPass(0)->getFragmentProgramParameters();
  const auto set = [&](const char* name, const std::array<float, kMaxTextures>& values) {
    fragment->setNamedConstant(name, Ogre::Vector4(values[0], values[1], values[2], values[3]));
  };
  set("begins", numbers.begin);
  set("ends", numbers.end);
  set("biases", numbers.bias);
  image_->update(false);

  Drawn out;
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
  const Ogre::PixelBox box(static_cast<Ogre::uint32>(width_), static_cast<Ogre::uint32>(height_), 1,
                           Ogre::PF_BYTE_RGBA, rgba.data());
  target_->getBuffer()->blitToMemory(box);
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    out.rgb.insert(out.rgb.end(), &rgba[i], &rgba[i] + 3);
    out.lit.push_back(static_cast<float>(rgba[i + 3]) / 255.0f);
  }
  return out;
}

Ogre::Camera* Stage::texture_camera(std::size_t i) const {
  return scene_->getShadowTexture(i)->getBuffer()->getRenderTarget()->getViewport(0)->getCamera();
}

void Stage::set_up_again() const {
  for (std::size_t i = 0; i < count_; ++i)
    setup_->getShadowCamera(scene_, viewer_, image_->getViewport(0), sun_, texture_camera(i), i);
}

std::string Stage::device() const {
  return singletons_->root->getRenderSystem()->getCapabilities()->getDeviceName();
}

}  // namespace sample
