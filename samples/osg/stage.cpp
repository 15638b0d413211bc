// OpenSceneGraph's side of the sample.
#include "stage.hpp"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Program>

#include <stdexcept>

namespace sample {
namespace {

// The unit that techniques put their map in, of which they make planes for coordinates in it.
constexpr int kUnit = 1;

constexpr const char* kVertex = R"(#version 120
varying vec4 at;
varying vec3 surface_normal;
void main() {
  vec4 eye = gl_ModelViewMatrix * gl_Vertex;
  at = vec4(dot(eye, gl_EyePlaneS[1]), dot(eye, gl_EyePlaneT[1]), dot(eye, gl_EyePlaneR[1]), dot(eye, gl_EyePlaneQ[1]));
  surface_normal = gl_Normal;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

// The map's sampler compares, and weighs four texels bilinearly.
constexpr const char* kFragment = R"(#version 120
uniform sampler2DShadow shadow_map;
uniform float bias;
uniform vec3 light;
varying vec4 at;
varying vec3 surface_normal;
float lit_share() {
  vec3 p = at.xyz / at.w;
  if (at.w <= 0.0 || any(lessThan(p.xy, vec2(0.0))) || any(greaterThan(p.xy, vec2(1.0)))) return 1.0;
  return shadow2D(shadow_map, vec3(p.xy, min(p.z - bias, 1.0))).r;
}
void main() {
  float cosine = max(-dot(normalize(surface_normal), light), 0.0);
  float lit = cosine > 0.0 ? lit_share() : 0.0;
  vec3 color = vec3(0.8, 0.77, 0.72) * (lit * cosine * vec3(1.0, 0.95, 0.85) + vec3(0.16, 0.19, 0.25) * (1.0 + 0.3 * surface_normal.y));
  gl_FragColor = vec4(pow(color, vec3(1.0 / 2.2)), lit);
}
)";

osg::Vec3d osg_from(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// A node for each box, as an engine's objects are culled one by one.
void add_boxes(const Street& street, osg::Group& group) {
  std::vector<Vertex> vertices;
  for (const gnomon::Box& box : street.boxes) {
    vertices.clear();
    append_box(box, vertices);
    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array, normals = new osg::Vec3Array;
    for (const Vertex& v : vertices) {
      positions->push_back({v.position.x, v.position.y, v.position.z});
      normals->push_back({v.normal.x, v.normal.y, v.normal.z});
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(positions);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertices.size())));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    group.addChild(geode);
  }
}

osg::ref_ptr<osg::GraphicsContext> hidden_context(int width, int height) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  traits->width = width;
  traits->height = height;
  traits->pbuffer = true;
  osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
  if (!context.valid()) throw std::runtime_error("no display with OpenGL: run it by xvfb-run -a");
  return context;
}

}  // namespace

Stage::Stage(const Street& street, int width, int height) {
  add_boxes(street, *scene_);
  osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
  const osg::Vec3d to_sun = osg_from(-glm::normalize(street.sun));
  sun->getLight()->setPosition(osg::Vec4d(to_sun, 0.0));
  scene_->addChild(sun);

  osg::StateSet* const state = scene_->getOrCreateStateSet();
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragment));
  state->setAttributeAndModes(program);
  state->addUniform(new osg::Uniform("shadow_map", kUnit));
  state->addUniform(new osg::Uniform("light", osg::Vec3f(-to_sun)));
  state->addUniform(bias_);

  viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer_.setSceneData(scene_);
  viewer_.setLightingMode(osg::View::NO_LIGHT);
  osg::Camera* const camera = viewer_.getCamera();
  camera->setGraphicsContext(hidden_context(width, height));
  camera->setViewport(0, 0, width, height);
  camera->setClearColor({0.62f, 0.74f, 0.9f, 1.0f});
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  image_->allocateImage(width, height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
  camera->attach(osg::Camera::COLOR_BUFFER, image_);
  viewer_.realize();
}

void Stage::use(osgShadow::ViewDependentShadowMap* technique,
                osgShadow::ShadowSettings::ShadowMapProjectionHint hint, int texels) {
  osg::ref_ptr<osgShadow::ShadowSettings> settings = new osgShadow::ShadowSettings;
  const auto side = static_cast<short>(texels);
  settings->setTextureSize({side, side});
  settings->setShadowMapProjectionHint(hint);
  settings->setBaseShadowTextureUnit(kUnit);
  settings->setShaderHint(osgShadow::ShadowSettings::NO_SHADERS);
  settings->setComputeNearFarModeOverride(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  scene_->setShadowSettings(settings);
  scene_->setShadowTechnique(technique);
}

void Stage::look(const gnomon::Camera& camera) {
  const double n = camera.near_depth;
  viewer_.getCamera()->setProjectionMatrixAsFrustum(camera.left * n, camera.right * n, camera.bottom * n,
                                                    camera.top * n, n, camera.far_depth);
  viewer_.getCamera()->setViewMatrixAsLookAt(osg_from(camera.position),
                                             osg_from(camera.position + camera.forward), osg_from(camera.up));
}

Drawn Stage::draw(const std::function<double()>& bias_of) {
  viewer_.frame();
  bias_->set(static_cast<float>(bias_of()));
  viewer_.frame();
  Drawn out;
  for (int row = image_->t() - 1; row >= 0; --row) {
    const unsigned char* const begin = image_->data(0, row);
    for (const unsigned char* pixel = begin; pixel < begin + 4 * image_->s(); pixel += 4) {
      out.rgb.insert(out.rgb.end(), pixel, pixel + 3);
      out.lit.push_back(static_cast<float>(pixel[3]) / 255.0f);
    }
  }
  return out;
}

std::string Stage::device() {
  viewer_.getCamera()->getGraphicsContext()->makeCurrent();
  return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace sample
