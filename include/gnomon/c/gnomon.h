// The C interface: which shadow maps are worth drawing? For C99 and newer, C++11 and newer, and languages
// that call C. This header includes nothing but <stdint.h>.
//
// Rules that hold everywhere:
// - Results live in the caller's memory. Handles are only what owns memory: gnomon_caster_set,
//   gnomon_history, gnomon_light_history, gnomon_depth_tracker. Their _create() allocates; no other call
//   does, unless its comment says so.
// - A struct whose first field is `size` may grow: later versions append fields. Its _default() function
//   sets `size` to the caller's sizeof and all other fields to their defaults. A library takes the
//   smaller struct of an older header, and refuses a larger one. Structs without `size` never change.
// - An array of structs that may grow comes with the size of one element, so that elements keep their
//   distance.
// - Status is the return value. On GNOMON_INVALID_INPUT, `*invalid_field` names the struct and its
//   field, such as "camera.far_depth". It is NULL otherwise. The text is static. `invalid_field` itself
//   may be NULL.
// - A refused call leaves its results unchanged, apart from `status` and counts, which a comment then
//   names.
// - Pointers are only read or written during the call. No call keeps one, except where a comment says
//   so.
// - Matrices are 16 numbers, column by column: row r of column c is m[4 * c + r]. They act on column
//   vectors: `clip_from_world` takes a point in world space to clip space. This is the order of OpenGL,
//   three.js and glTF.
// - Boxes are six doubles each: least x, y, z, then largest x, y, z. A box whose least exceeds its
//   largest is empty, and takes no part in anything. Points and directions are three doubles each.
// - The world is right-handed unless gnomon_clip_space says otherwise. Lengths are in world units,
//   angles in radians.
// - Flags are int32_t: 0 is false, anything else true. Numbers beyond 1e30 and not-a-number are refused.
// - Equal input gives equal bits, on every compiler and processor. No call has global state, sets errno or
//   throws. gnomon_occluder_search is the only way to be called back. Calls on different handles may run on
//   different threads.
// - A call takes up to 512 kB of stack, and gnomon_make_plan 256 kB. Give threads and WebAssembly
//   modules as much.
//
// Calls marked GNOMON_API keep their meaning within a major version. Those marked GNOMON_EXPERIMENTAL may
// change in a minor one. Until version 1.0, a minor version may change both; GNOMON_C_ABI_VERSION then grows.
#ifndef GNOMON_C_GNOMON_H
#define GNOMON_C_GNOMON_H

#include <stdint.h>

/// Version of this header. gnomon_version() is that of the library.
#define GNOMON_VERSION_MAJOR 0
#define GNOMON_VERSION_MINOR 1
#define GNOMON_VERSION_PATCH 0
/// Number of the C interface: the suffix of libgnomon.so. Programs run with any library of the same number
/// whose version is not older than their header.
#define GNOMON_C_ABI_VERSION 0

#if defined(_WIN32) && defined(GNOMON_BUILDS_C)
#define GNOMON_API __declspec(dllexport)
#elif defined(_WIN32) && defined(GNOMON_SHARED_C)
#define GNOMON_API __declspec(dllimport)
#elif defined(__GNUC__)
#define GNOMON_API __attribute__((visibility("default")))
#else
#define GNOMON_API
#endif
/// As GNOMON_API, for calls that may change in a minor version.
#define GNOMON_EXPERIMENTAL GNOMON_API

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------- status, limits, names

/// Results of calls.
enum {
  GNOMON_OK = 0,               ///< done; of a plan: there are maps to draw
  GNOMON_NOTHING_VISIBLE = 1,  ///< of a plan: no receiver in view, no map, everything in view is lit
  GNOMON_NO_CASTER = 2,        ///< of a plan: receivers in view, but nothing can shadow them: no map
  GNOMON_INVALID_INPUT = 3,    ///< refused: `*invalid_field` names what is wrong
  GNOMON_OUT_OF_MEMORY = 4     ///< of _create() and _resize() alone: there is no memory
};

enum {
  GNOMON_MAX_MAPS = 8,               ///< maps of one plan
  GNOMON_MAX_CULL_PLANES = 32,       ///< planes round what casts into a map
  GNOMON_MAX_SELECT_PLANES = 4,      ///< planes round a map's share of the receivers
  GNOMON_MAX_WARP_PLANES = 3,        ///< planes that get a map of their own
  GNOMON_MAX_OMISSIONS = 32,         ///< omissions that a plan lists; more are counted alone
  GNOMON_MAX_VIEWS = 8,              ///< cameras of one plan
  GNOMON_MAX_LIGHTS = 4096,          ///< lights of one gnomon_plan_lights
  GNOMON_SHAPE_PARAMETERS = 15,      ///< numbers that a shape is set by
  GNOMON_DEPTH_BINS = 352,           ///< bins of gnomon_visible_depths
  GNOMON_SHADER_BLOCK_FLOATS = 460,  ///< floats of a shader block
  GNOMON_JITTER_FRAMES = 64          ///< frames after which gnomon_jitter_texels repeats
};

/// The lists that names are looked up in. Each entry has an index, a name as in case files, and one line of
/// text.
enum {
  GNOMON_WARPS = 0,          ///< gnomon_plan_options::warp, gnomon_map::warp
  GNOMON_SHAPES = 1,         ///< gnomon_plan_options::warp_shape, gnomon_map::shape
  GNOMON_FITS = 2,           ///< gnomon_plan_options::fit
  GNOMON_SPLITS = 3,         ///< gnomon_plan_options::split_scheme
  GNOMON_PARTITIONS = 4,     ///< gnomon_plan_options::split_partition
  GNOMON_SELECTIONS = 5,     ///< gnomon_plan_options::split_selection, gnomon_plan::selection
  GNOMON_OBJECTIVES = 6,     ///< gnomon_plan_options::warp_objective
  GNOMON_PRUNE_RULES = 7,    ///< bits of gnomon_plan_options::prune: an entry's bit is 1 << index
  GNOMON_PAGE_POLICIES = 8,  ///< gnomon_page_options::policy
  GNOMON_STATUSES = 9        ///< what calls return
};
enum {
  GNOMON_DEFAULT = -1,  ///< an index that lets the library choose, where the field's comment says so
  GNOMON_UNKNOWN = -2   ///< what gnomon_find returns for a name that is not there; refused as an option
};

/// Entries of a list, GNOMON_WARPS to GNOMON_STATUSES. 0 for any other list.
GNOMON_API int32_t gnomon_count(int32_t list);
/// Name of an entry, zero-terminated and static. NULL where there is no such list or index.
GNOMON_API const char* gnomon_name(int32_t list, int32_t index);
/// One line about an entry, static. "" for lists whose names say it all, NULL where there is no such entry.
GNOMON_API const char* gnomon_summary(int32_t list, int32_t index);
/// Index of a name, or GNOMON_UNKNOWN where the list has none such; NULL is no name. Names stay, indices may
/// change between versions: find them at start.
GNOMON_API int32_t gnomon_find(int32_t list, const char* name);

/// Version of the library as "major.minor.patch", static.
GNOMON_API const char* gnomon_version(void);

// ---------------------------------------------------------------- clip space, camera

/// Clip space of matrices. All zero: OpenGL. Its size is fixed.
typedef struct gnomon_clip_space {
  int32_t zero_to_one;         ///< flag: depth after the division by w is 0..1 (Vulkan, Direct3D); 0: -1..1
  int32_t reversed_z;          ///< flag: depth grows towards the light, or the eye
  int32_t y_down;              ///< flag: y grows downwards in clip space (Vulkan)
  int32_t left_handed;         ///< flag: the caller's world is left-handed (Unity, most Direct3D engines)
  int32_t first_row_at_y_max;  ///< flag: the first row in memory is at ndc y = 1 (Direct3D, Metal, WebGPU)
  int32_t reserved;            ///< 0
} gnomon_clip_space;

/// A viewing camera. View depth is positive forward: dot(point - position, forward).
typedef struct gnomon_camera {
  uint32_t size;         ///< set by gnomon_camera_default
  int32_t orthographic;  ///< flag: parallel projection; default 0
  double position[3];    ///< eye, world space; default 0 0 0
  double forward[3];     ///< view direction, any length above 0; default 0 0 -1
  double up[3];          ///< any vector not along forward; along forward, a fixed axis is used; default 0 1 0
  /// Edges of the image, left < right and bottom < top; defaults -1 and 1. Offsets per unit of view depth for
  /// a perspective camera, world units for an orthographic one.
  double left, right, bottom, top;
  double near_depth;  ///< view depth where the image begins, above 0 for perspective; default 0.1
  double far_depth;   ///< view depth where it ends, above near_depth; infinity: sees without end; default 100
  int32_t width;      ///< pixels, 1..2^20; default 1920
  int32_t height;     ///< pixels, 1..2^20; default 1080
} gnomon_camera;

/// Fills in defaults. `size`: sizeof *camera. Refuses NULL and sizes that no version had: "camera.size".
GNOMON_API int32_t gnomon_camera_default(gnomon_camera* camera, uint32_t size);
/// Sets a symmetric perspective; all other fields are unchanged. `fov_y`: full vertical angle, radians, in
/// (0, pi). `aspect`: width over height, above 0. `width`, `height`: pixels.
GNOMON_API int32_t gnomon_perspective(gnomon_camera* camera, double fov_y, double aspect, double near_depth,
                                      double far_depth, int32_t width, int32_t height,
                                      const char** invalid_field);
/// Sets a parallel projection of `height_world` world units from bottom to top; all other fields are
/// unchanged.
GNOMON_API int32_t gnomon_orthographic(gnomon_camera* camera, double height_world, double aspect,
                                       double near_depth, double far_depth, int32_t width, int32_t height,
                                       const char** invalid_field);
/// Makes the camera of an engine's own matrices: perspective or parallel, centred or off-axis, far plane
/// finite or not. `clip_space` is that of `clip_from_view`; NULL: OpenGL. Matrices may be rounded to float.
/// Views may scale evenly. Refuses what is no camera. `*why`, unless NULL, is then one static sentence
/// without a full stop, else NULL. `camera` comes from gnomon_camera_default.
GNOMON_API int32_t gnomon_camera_from(const double view_from_world[16], const double clip_from_view[16],
                                      const gnomon_clip_space* clip_space, int32_t width, int32_t height,
                                      gnomon_camera* camera, const char** why, const char** invalid_field);
/// Writes the matrix from a map's clip space to its texture. x and y are 0..1 from the first texel of the
/// first row on, z is the depth in 0..1. `clip_space`: of the map; NULL: OpenGL.
GNOMON_API int32_t gnomon_texture_from_clip(const gnomon_clip_space* clip_space,
                                            double texture_from_clip[16]);

// ---------------------------------------------------------------- light

enum {
  GNOMON_DIRECTIONAL = 0,  ///< parallel light: `direction`
  GNOMON_SPOT = 1,         ///< a cone: `position`, `direction`, `outer_radians`, `range`
  GNOMON_POINT = 2         ///< all directions: `position`, `range`
};
/// A light that casts shadows. Fields that its kind does not name are not read.
typedef struct gnomon_light {
  uint32_t size;         ///< set by gnomon_light_default
  int32_t kind;          ///< GNOMON_DIRECTIONAL, the default, GNOMON_SPOT or GNOMON_POINT
  double position[3];    ///< world space; default 0 0 0
  double direction[3];   ///< the way the light travels, any length above 0; default 0 -1 0
  double outer_radians;  ///< half angle of the cone, in (0, pi); default 0.5
  double range;          ///< world units, above 0: nothing is lit beyond; default 100
} gnomon_light;
/// Fills in defaults. `size`: sizeof *light. Refuses NULL and sizes that no version had.
GNOMON_API int32_t gnomon_light_default(gnomon_light* light, uint32_t size);

// ---------------------------------------------------------------- boxes

/// Boxes sorted into a tree, for scenes with hundreds of boxes and more. Gives the same plans as a list, bit
/// for bit.
typedef struct gnomon_caster_set gnomon_caster_set;

/// Sorts `count` boxes into a new set, which owns a copy of them: about 64 bytes a box. Takes O(count log
/// count).
/// `*set` is NULL where the call fails. Empty boxes keep their place, and are never listed.
GNOMON_API int32_t gnomon_caster_set_create(const double* boxes, int64_t count, gnomon_caster_set** set,
                                            const char** invalid_field);
/// Frees the set; NULL does nothing.
GNOMON_API void gnomon_caster_set_destroy(gnomon_caster_set* set);
/// Boxes in the set, empty ones included; 0 for NULL.
GNOMON_API int64_t gnomon_caster_set_count(const gnomon_caster_set* set);
/// Takes new bounds for all boxes, in their first order. Right for any motion, fast while neighbours stay
/// neighbours. `count` is gnomon_caster_set_count.
GNOMON_API int32_t gnomon_caster_set_refit(gnomon_caster_set* set, const double* boxes, int64_t count,
                                           const char** invalid_field);
/// Takes new bounds for the box `index`. Takes O(log count).
GNOMON_API int32_t gnomon_caster_set_update(gnomon_caster_set* set, int64_t index, const double box[6],
                                            const char** invalid_field);

/// Casters of shadows, and receivers that they fall on: each a list of boxes or a set. Both may be the same.
typedef struct gnomon_scene {
  uint32_t size;            ///< set by gnomon_scene_default
  uint32_t reserved;        ///< 0
  const double* casters;    ///< boxes, six doubles each; NULL with a count of 0 or with a set; default NULL
  int64_t caster_count;     ///< boxes of the list, at least 0; default 0
  const double* receivers;  ///< the same of what shadows fall on
  int64_t receiver_count;   ///< the same
  const gnomon_caster_set* caster_set;    ///< in place of the list, or NULL, the default
  const gnomon_caster_set* receiver_set;  ///< the same
} gnomon_scene;
/// Fills in defaults: a scene without boxes. `size`: sizeof *scene.
GNOMON_API int32_t gnomon_scene_default(gnomon_scene* scene, uint32_t size);

// ---------------------------------------------------------------- view

/// Visible view depths of a frame: pixels in each bin of the logarithm of depth. Its size is fixed.
typedef struct gnomon_visible_depths {
  uint32_t count[GNOMON_DEPTH_BINS];  ///< eight bins per doubling, from 2^-20 world units on
  double min;                         ///< nearest visible depth, world units; min > max: nothing is visible
  double max;                         ///< farthest visible depth, world units
} gnomon_visible_depths;
/// Sets it to no visible depth. NULL does nothing.
GNOMON_API void gnomon_visible_depths_clear(gnomon_visible_depths* depths);
/// Counts the view depths of pixels. Not counted, as the sky: 0, less, infinity, not a number.
GNOMON_API int32_t gnomon_visible_depths_add(gnomon_visible_depths* depths, const float* view_depths,
                                             int64_t count, const char** invalid_field);

/// A camera, and what is known of the surfaces that it sees.
typedef struct gnomon_view {
  uint32_t size;                        ///< set by gnomon_view_default
  uint32_t reserved;                    ///< 0
  const gnomon_camera* camera;          ///< required; default NULL
  const gnomon_visible_depths* depths;  ///< of this frame or the last ones; NULL, the default: unknown
  /// Points of surfaces that the camera sees, world space, three doubles each: of a depth buffer, or first
  /// hits of rays. NULL, the default: unknown. Time grows with their number.
  const double* points;
  /// Unit normals at the points towards the eye, as many; NULL, the default: unknown. Pages read them, and
  /// warps do not serve points that are turned from the light.
  const double* normals;
  int64_t point_count;  ///< points, at least 0; default 0
} gnomon_view;
/// Fills in defaults. `size`: sizeof *view.
GNOMON_API int32_t gnomon_view_default(gnomon_view* view, uint32_t size);

/// Visible depths that are followed from frame to frame. Depths that come into view count at once, and those
/// that leave it are given up slowly. Keep one per camera.
typedef struct gnomon_depth_tracker gnomon_depth_tracker;
/// A new, empty tracker, or NULL where there is no memory or a number is out of 1..65535. `frames_per_bin`:
/// frames that the nearest and the farthest depth take to move inwards by one bin; 4 suits most scenes.
/// `hold_frames`: frames for which a depth between them that shows nothing any more still counts; 30 does.
GNOMON_EXPERIMENTAL gnomon_depth_tracker* gnomon_depth_tracker_create(int32_t frames_per_bin,
                                                                      int32_t hold_frames);
/// Frees the tracker; NULL does nothing.
GNOMON_EXPERIMENTAL void gnomon_depth_tracker_destroy(gnomon_depth_tracker* tracker);
/// Forgets all frames: call it at a cut. NULL does nothing.
GNOMON_EXPERIMENTAL void gnomon_depth_tracker_clear(gnomon_depth_tracker* tracker);
/// Takes the visible depths of the next frame, and writes those to plan with to `depths`, which may be
/// `frame`. A frame that shows nothing changes nothing. Before the first surface `depths` shows nothing
/// either.
GNOMON_EXPERIMENTAL int32_t gnomon_depth_tracker_update(gnomon_depth_tracker* tracker,
                                                        const gnomon_visible_depths* frame,
                                                        gnomon_visible_depths* depths,
                                                        const char** invalid_field);

// ---------------------------------------------------------------- options

enum {
  GNOMON_RANGE_AUTOMATIC = 0,  ///< GNOMON_RANGE_RECEIVERS; for fit stable, and cascades with a cadence,
                               ///< depths up to the farthest receiver
  GNOMON_RANGE_RECEIVERS = 1,  ///< depths that hold receivers in view
  GNOMON_RANGE_CAMERA = 2      ///< all depths of the camera
};

/// Options of a plan. Every default suits most scenes. The names are those of PlanOptions in
/// gnomon/options.hpp, with an underscore for each dot.
typedef struct gnomon_plan_options {
  uint32_t size;  ///< set by gnomon_plan_options_default
  /// Maps along the view, 1..GNOMON_MAX_MAPS; default 4. More lower the error far away and cost a pass each.
  /// Directional lights only: a spot light has one map, a point light or a wide spot light up to six.
  int32_t cascades;
  int32_t resolution_max_size;  ///< texels along each side of each map, 4..16384; default 1024
  /// World sizes per octave that maps of fit stable may have, 1..1024; default 1024. Fewer keep the grid
  /// unchanged through a zoom, and enlarge texels by up to 1 / steps.
  int32_t resolution_stable_size_steps;
  /// Error m (screen pixels per texel) that suffices; 0, the default: none. Above 0, the plan takes the
  /// fewest cascades and the smallest maps that meet it.
  double resolution_max_error;
  /// Most texels of all maps together; 0, the default: no budget. By objective picture, divided so that the
  /// mean error over visible points is least; else, so that all maps have the same worst error.
  int64_t resolution_texel_budget;
  double resolution_prune_error;  ///< error m that prune rule metric_resolution shrinks maps to, >= 1e-9;
                                  ///< default 1

  /// GNOMON_FITS; default tight: the best texels. `stable` keeps texels at their place in the world under
  /// camera motion.
  int32_t fit;

  int32_t split_scheme;      ///< GNOMON_SPLITS: how depths are divided among cascades; default auto
  double split_lambda;       ///< practical: from uniform (0) to logarithmic (1); default 0.7
  double split_pseudo_near;  ///< view depth from which error counts, world units, >= 0; default 0
  int32_t split_range;       ///< GNOMON_RANGE_AUTOMATIC, the default, and others: which depths are divided
  int32_t
      split_selection;  ///< GNOMON_SELECTIONS: view_depth, the default, or finest; how a point finds its map
  double split_given[7];  ///< scheme given: cascades - 1 ascending view depths between cascades, all finite;
                          ///< default infinity
  double split_overlap;   ///< blend band before a cascade, share of the depths before it, 0..1; default 0
  int32_t split_partition;    ///< GNOMON_PARTITIONS: how receivers are divided; default view_depth
  int32_t split_face_slices;  ///< partition frustum_faces: most slices of a side face, 1..8; default 1

  /// GNOMON_WARPS; GNOMON_DEFAULT, the default: the plan measures, and takes what lowers the error most. A
  /// warp that does not lower it is dropped and listed.
  int32_t warp;
  int32_t warp_shape;      ///< GNOMON_SHAPES: how texels lie; default linear. Others need more of a renderer
  int32_t warp_objective;  ///< GNOMON_OBJECTIVES: the error that a warp must lower; default picture
  int32_t reserved;        ///< 0
  double warp_focus[6];    ///< box whose error counts more; an empty one, the default: none
  double warp_focus_weight;  ///< how many times, 1..1e6; default 4
  /// Planes that get a map each, as point (3), normal (3) and thickness (1). A thickness of 0, the default:
  /// no plane. Receivers within the thickness of a plane, world units, to either side, take its map.
  double warp_planes[GNOMON_MAX_WARP_PLANES][7];

  /// Frames from one plan of a cascade behind the first to its next, 1..64; default 1. More need a history.
  int32_t cadence_frames;
  uint32_t prune;  ///< bits of GNOMON_PRUNE_RULES; default: the exact ones, light_depths and equal_cascades
  double cadence_largest_step;  ///< largest step of the eye from frame to frame, world units, >= 0; default 0
  double cadence_largest_turn;  ///< largest turn of the camera from frame to frame, radians, 0..pi; default 0

  double filter_texels;  ///< kernel radius of the filter, texels, 0..a quarter of the map; default 1
  double filter_world;   ///< the same in world units, >= 0; default 0. The wider of the two counts

  double bias_constant_texels;       ///< along the light, texels, >= 0; default 0.15
  double bias_slope_texels;          ///< along the light, texels times tan(normal, light), >= 0; default 0.5
  double bias_normal_offset_texels;  ///< along the normal, texels times sin(normal, light), >= 0; default 0.1
  double bias_max_slope;             ///< cap of tan(normal, light) in the slope term, >= 0; default 4

  /// Local lights: where maps begin, over the distance of the farthest receiver, 1e-7..0.5; default 2^-10.
  double light_near_share;
  gnomon_clip_space clip_space;  ///< of all matrices of the plan; default OpenGL
} gnomon_plan_options;
/// Fills in defaults. `size`: sizeof *options.
GNOMON_API int32_t gnomon_plan_options_default(gnomon_plan_options* options, uint32_t size);

// ---------------------------------------------------------------- plan

/// Texels [x, x + width) times [y, y + height) of a map, as its memory is: columns from ndc x = -1. Its
/// size is fixed.
typedef struct gnomon_texel_rect {
  int32_t x, y, width, height;  ///< texels; empty where width or height is 0
} gnomon_texel_rect;

/// One shadow map: what drawing, reading, culling and measuring it needs. For maps of one's own (foreign
/// matrices), fill in defaults, then clip_from_world, width, height and the depths.
typedef struct gnomon_map {
  uint32_t size;                        ///< set by gnomon_map_default, and by calls that write maps
  int32_t cascade;                      ///< index of the cascade, face or part that the map serves
  double clip_from_world[16];           ///< clip space of the map from world space
  float clip_from_camera_relative[16];  ///< the same for points relative to gnomon_plan::origin
  double depth_begin;                   ///< view depth from which the map serves points, world units
  double depth_end;                     ///< view depth up to which it does, world units
  double overlap;                       ///< width of the blend band before depth_begin, world units
  double light_world[4];  ///< the light's position with w = 1, or unit direction towards it with w = 0
  int32_t width;          ///< texels
  int32_t height;         ///< texels
  int32_t shape;          ///< GNOMON_SHAPES
  int32_t warp;           ///< GNOMON_WARPS: the one that was used; GNOMON_DEFAULT: not known
  double shape_parameters[GNOMON_SHAPE_PARAMETERS];  ///< of the shape
  double kappa;                  ///< strength of the warp, 1 / world units; local lights: 1 / slope; 0: none
  double texel_world[2];         ///< extent of a texel across the light at the body's centre, world units
  double texel_world_max[2];     ///< the same where it is largest
  double depth_range_world;      ///< from near to far plane along the light, world units
  double bias_constant;          ///< bias at the body's centre along the light, world units
  double bias_slope;             ///< the same per unit of tan(normal, light)
  double bias_normal_offset;     ///< along the normal, world units, per unit of sin(normal, light)
  int32_t filter_margin_texels;  ///< border that no receiver falls into, texels along each side
  int32_t cull_plane_count;      ///< entries of cull_planes that are used
  /// Planes round all that can shadow a receiver of this map. A caster counts if part of it lies where
  /// dot(xyz, p) + w >= 0 for all of them. World space, unit normals. Unused ones are 0.
  double cull_planes[GNOMON_MAX_CULL_PLANES][4];
  int32_t select_plane_count;  ///< entries of select_planes that are used
  int32_t snap_valid;          ///< flag: the grid is that of fit stable, and the snap fields hold
  double select_planes[GNOMON_MAX_SELECT_PLANES]
                      [4];                  ///< the map serves a point only inside all of them; as above
  int64_t snap_x, snap_y;                   ///< place of the grid, texels
  int64_t snap_depth_near, snap_depth_far;  ///< depth range of the grid, depth steps
  double snap_texel[2];                     ///< sides of a texel of the grid, world units
  double m_s_max, m_t_max;  ///< largest perspective error along the map's x and y, screen pixels per texel
  double m_max;             ///< bound of the perspective error in any direction, screen pixels per texel
  double storage;           ///< texels per screen pixel for an error of 1 everywhere in this map
} gnomon_map;
/// Fills in defaults: an empty map of linear texels, GNOMON_DEFAULT as warp. `size`: sizeof *map.
GNOMON_API int32_t gnomon_map_default(gnomon_map* map, uint32_t size);

/// Why something is not in a plan.
enum {
  GNOMON_CASCADE_WITHOUT_RECEIVER = 0,  ///< a: depth_begin, b: depth_end
  GNOMON_CASCADE_WITHOUT_CASTER = 1,    ///< a: depth_begin, b: depth_end
  GNOMON_DEPTH_WITHOUT_RECEIVER = 2,    ///< the camera's depths were cut: a: depth_begin, b: depth_end
  GNOMON_DEPTH_NOT_VISIBLE = 3,    ///< gnomon_view::depths shows nothing there: a: depth_begin, b: depth_end
  GNOMON_WARP_WITHOUT_GAIN = 4,    ///< a: objective with the warp over that without; infinite: it fits none
  GNOMON_WARP_IN_STABLE_FIT = 5,   ///< fit stable takes no warp
  GNOMON_PART_WITHOUT_CASTER = 6,  ///< of a partition; a: depth_begin, b: depth_end
  GNOMON_PARTITION_WITHOUT_GAIN = 7,    ///< a: objective of the parts over that of one map
  GNOMON_PARTITION_IN_STABLE_FIT = 8,   ///< fit stable takes no other partition
  GNOMON_FACE_WITHOUT_RECEIVER = 9,     ///< of a local light
  GNOMON_FACE_WITHOUT_CASTER = 10,      ///< of a local light
  GNOMON_RESOLUTION_WITHOUT_GAIN = 11,  ///< a smaller map suffices; a: bound of m at full size, b: now
  GNOMON_DEPTH_NEAR_LIGHT = 12,         ///< nearer than depth a on the map's axis nothing casts; b: casters
  GNOMON_OPTION_IGNORED = 13,           ///< a: which, GNOMON_IGNORED_PARTITION and others
  GNOMON_VIEW_WITHOUT_RECEIVER = 14,    ///< of gnomon_plan_views; a: index of the camera
  GNOMON_PAGES_COARSENED = 15,          ///< the pool is too small; a: requested error, b: planned error
  GNOMON_POINTS_LEFT_COARSER = 16,      ///< by gnomon_page_options::share; a: how many
  GNOMON_POINTS_BEYOND_LEVELS = 17,     ///< the deepest level does not suffice; a: how many
  GNOMON_SHAPE_WITHOUT_GAIN = 18,       ///< a: error with the shape over that without
  GNOMON_PLANE_WITHOUT_RECEIVER = 19,   ///< a: index in warp_planes
  GNOMON_PLANE_WITHOUT_CASTER = 20,     ///< a: index in warp_planes
  GNOMON_CASCADE_ON_PLANES = 21,        ///< maps of warp_planes serve all of it; a: depth_begin, b: depth_end
  GNOMON_FACES_LESS_DIVIDED = 22,       ///< no map is left for a slice; a: slices, b: split_face_slices
  GNOMON_RECEIVER_NEAR_LIGHT = 23,      ///< receivers nearer than a to the light are lit; b: their boxes
  GNOMON_CASCADE_WITHOUT_GAIN = 24      ///< the next map serves it with the same texels; a, b: depths
};
/// The option that GNOMON_OPTION_IGNORED is about.
enum {
  GNOMON_IGNORED_PARTITION = 0,       ///< split_partition
  GNOMON_IGNORED_SPLIT_SCHEME = 1,    ///< split_scheme
  GNOMON_IGNORED_SPLIT_OVERLAP = 2,   ///< split_overlap
  GNOMON_IGNORED_VISIBLE_DEPTHS = 3,  ///< gnomon_view::depths
  GNOMON_IGNORED_TEXEL_BUDGET = 4,    ///< resolution_texel_budget
  GNOMON_IGNORED_HISTORY = 5,         ///< the history
  GNOMON_IGNORED_SELECTION = 6,       ///< split_selection
  GNOMON_IGNORED_CADENCE = 7,         ///< cadence_frames
  GNOMON_IGNORED_VISIBLE_POINTS = 8,  ///< gnomon_view::points
  GNOMON_IGNORED_SHAPE = 9,           ///< warp_shape
  GNOMON_IGNORED_PLANES = 10,         ///< warp_planes
  GNOMON_IGNORED_PAGE_SHARE = 11,     ///< gnomon_page_options::share
  GNOMON_IGNORED_PAGE_REACH = 12      ///< gnomon_page_options::reach_texels
};
/// Something that this scene did not need, or an option that did not hold. Its size is fixed.
typedef struct gnomon_omission {
  int32_t kind;          ///< GNOMON_CASCADE_WITHOUT_RECEIVER and others: decides what a and b hold
  int32_t map;           ///< the cascade or face that it is about, as gnomon_map::cascade; -1: the whole plan
  double a, b;           ///< as the kind states
  int64_t saves_texels;  ///< texels that are not drawn
} gnomon_omission;
/// Two lines of English. Its size is fixed.
typedef struct gnomon_text {
  char what[48];  ///< zero-terminated
  char why[144];  ///< zero-terminated
} gnomon_text;
/// Puts an omission into words. NULL for either does nothing; a kind that is none gives empty lines.
GNOMON_API void gnomon_describe(const gnomon_omission* omission, gnomon_text* text);

/// A plan. Its maps lie in the caller's array. Set the fields marked "in" before the call; the others are
/// results.
///
///     gnomon_map maps[GNOMON_MAX_MAPS];
///     gnomon_plan plan;
///     gnomon_plan_default(&plan, sizeof plan);
///     plan.maps = maps, plan.map_size = sizeof maps[0], plan.map_room = GNOMON_MAX_MAPS;
typedef struct gnomon_plan {
  uint32_t size;                 ///< set by gnomon_plan_default
  uint32_t map_size;             ///< in: sizeof(gnomon_map)
  gnomon_map* maps;              ///< in: where maps are written
  gnomon_omission* omissions;    ///< in: where omissions are written, or NULL, the default
  int32_t map_room;              ///< in: entries of maps; GNOMON_MAX_MAPS always suffice
  int32_t omission_room;         ///< in: entries of omissions; GNOMON_MAX_OMISSIONS always suffice
  int32_t status;                ///< as the call returned
  int32_t map_count;             ///< maps to draw; 0 unless status is GNOMON_OK
  int32_t omission_count;        ///< omissions; may exceed omission_room
  int32_t selection;             ///< GNOMON_SELECTIONS: how a point finds its map
  int32_t sizes_vary;            ///< flag: sizes of maps may change from frame to frame
  int32_t reserved;              ///< 0
  double origin[3];              ///< what clip_from_camera_relative is relative to, world space: the camera
  double light_direction[3];     ///< unit, the way the light travels; of a point light towards the camera
  gnomon_clip_space clip_space;  ///< of all matrices of the plan
  double bias_constant_texels;   ///< of the options
  double bias_slope_texels;      ///< of the options
  double bias_normal_offset_texels;  ///< of the options
  double bias_max_slope;             ///< of the options
} gnomon_plan;
/// Fills in defaults: no room, no map. `size`: sizeof *plan.
GNOMON_API int32_t gnomon_plan_default(gnomon_plan* plan, uint32_t size);

/// State that plans carry from frame to frame. Keep one per camera and light.
typedef struct gnomon_history gnomon_history;
/// A new, empty history, or NULL where there is no memory. About 20 kB.
GNOMON_API gnomon_history* gnomon_history_create(void);
/// Frees the history; NULL does nothing.
GNOMON_API void gnomon_history_destroy(gnomon_history* history);
/// Forgets all frames: call it at a cut. NULL does nothing.
GNOMON_API void gnomon_history_clear(gnomon_history* history);
/// Makes `to` equal to `from`, to try a frame twice. NULL for either does nothing.
GNOMON_API void gnomon_history_copy(const gnomon_history* from, gnomon_history* to);

enum {
  GNOMON_MAP_APPEARED = 0,  ///< nothing was remembered of this cascade
  GNOMON_MAP_REFITTED = 1,  ///< fit warped_stable: the view left the map
  GNOMON_DENSITY_JUMP = 2   ///< texels per area of some surface point changed by more than 5 %
};
/// A discontinuity of one map from the last frame to this one. Its size is fixed.
typedef struct gnomon_event {
  int32_t kind;          ///< GNOMON_MAP_APPEARED and others
  int32_t map;           ///< gnomon_map::cascade
  double density_ratio;  ///< texels per area of now over before, where it is farthest from 1
} gnomon_event;
/// Writes the events of the last plan, at most `room`. Returns how many there are; 0 for NULL.
GNOMON_API int32_t gnomon_history_events(const gnomon_history* history, gnomon_event* events, int32_t room);

/// Chooses the shadow maps of one light for one view. `options`: NULL for defaults. `history`: NULL for a
/// plan of its own. Returns GNOMON_OK, GNOMON_NOTHING_VISIBLE, GNOMON_NO_CASTER or GNOMON_INVALID_INPUT, and
/// sets `plan->status` to the same. Refused input leaves no map. Allocates nothing.
GNOMON_API int32_t gnomon_make_plan(const gnomon_view* view, const gnomon_light* light,
                                    const gnomon_scene* scene, const gnomon_plan_options* options,
                                    gnomon_history* history, gnomon_plan* plan, const char** invalid_field);
/// Chooses the maps that several cameras share: two eyes, a split screen, faces of a probe. `cameras`:
/// `count` pointers, 1..GNOMON_MAX_VIEWS. gnomon_plan::origin is the mean of the eyes. Otherwise as
/// gnomon_make_plan.
GNOMON_EXPERIMENTAL int32_t gnomon_plan_views(const gnomon_camera* const* cameras, int32_t count,
                                              const gnomon_light* light, const gnomon_scene* scene,
                                              const gnomon_plan_options* options, gnomon_plan* plan,
                                              const char** invalid_field);

/// Finds the map of each point: `indices[i]` is its index in the plan's maps, or -1 where the point is lit.
/// `points`: world space, three doubles each. `view_depths`: of the points, world units.
GNOMON_API int32_t gnomon_select(const gnomon_plan* plan, const double* points, const double* view_depths,
                                 int64_t count, int32_t* indices, const char** invalid_field);

/// Writes the indices of the boxes that a map needs to `indices`, at most `room`, and how many there are to
/// `*found`. No caster that can shadow a receiver of the map is missing.
GNOMON_API int32_t gnomon_cull(const gnomon_map* map, const double* casters, int64_t count, uint32_t* indices,
                               int64_t room, int64_t* found, const char** invalid_field);
/// The same of a set, in no particular order. Time grows with what lies across the planes.
GNOMON_API int32_t gnomon_cull_set(const gnomon_map* map, const gnomon_caster_set* set, uint32_t* indices,
                                   int64_t room, int64_t* found, const char** invalid_field);
/// The same for planes of one's own, four doubles each, 0..GNOMON_MAX_CULL_PLANES: gnomon_rectangle_planes,
/// say.
GNOMON_API int32_t gnomon_cull_planes(const double* planes, int32_t plane_count, const gnomon_caster_set* set,
                                      uint32_t* indices, int64_t room, int64_t* found,
                                      const char** invalid_field);

/// Makes `to` equal to `map` with clip_from_camera_relative for an eye at `origin`, world space: for a map
/// that was kept from an earlier frame. `to` comes from gnomon_map_default, and may be `map` itself.
GNOMON_API int32_t gnomon_rebased(const gnomon_map* map, const double origin[3], gnomon_map* to,
                                  const char** invalid_field);

enum {
  GNOMON_REUSE_NONE = 0,       ///< draw the whole map
  GNOMON_REUSE_IDENTICAL = 1,  ///< every texel holds
  GNOMON_REUSE_SCROLLED = 2    ///< `kept` holds once moved; draw the strips
};
/// How to make a map from that of the last frame. Its size is fixed.
typedef struct gnomon_reuse {
  int32_t kind;                ///< GNOMON_REUSE_NONE and others
  int32_t shift_x, shift_y;    ///< texel (x, y) of the old map is (x + shift_x, y + shift_y) of the new one
  int32_t strip_count;         ///< strips to draw, 0..2
  gnomon_texel_rect kept;      ///< part of the new map whose texels hold
  gnomon_texel_rect strip[2];  ///< parts to draw
} gnomon_reuse;
/// Compares two maps of plans with this clip space; NULL: OpenGL. Casters must not have moved, and both
/// frames must have drawn all casters over the map (gnomon_rectangle_planes) with depth clamp.
GNOMON_API int32_t gnomon_compare(const gnomon_map* previous, const gnomon_map* current,
                                  const gnomon_clip_space* clip_space, gnomon_reuse* reuse,
                                  const char** invalid_field);
/// Five planes round all that can throw a shadow into a rectangle of a map, for gnomon_cull_planes. Open
/// towards the light.
GNOMON_API int32_t gnomon_rectangle_planes(const gnomon_map* map, const gnomon_texel_rect* rectangle,
                                           const gnomon_clip_space* clip_space, double planes[20],
                                           const char** invalid_field);

/// Fills the uniform block of shaders/library/shadow_block.glsl, for std140 and std430:
/// GNOMON_SHADER_BLOCK_FLOATS floats. `layer_width`, `layer_height`: texels of a layer of the texture; 0:
/// those of the largest map. `blur_texels`: half side of the box that stored texels were blurred with, 0:
/// none.
GNOMON_API int32_t gnomon_shader_block(const gnomon_plan* plan, int32_t layer_width, int32_t layer_height,
                                       double blur_texels, float block[GNOMON_SHADER_BLOCK_FLOATS],
                                       const char** invalid_field);

enum {
  /// Rasterizer states: a constant, and a factor times the growth of depth over a texel (glPolygonOffset,
  /// Direct3D, Vulkan, Metal).
  GNOMON_BIAS_RASTERIZER = 0,
  /// A constant, and a move along the normal before the look-up (three.js, Babylon.js, Unity, Godot).
  GNOMON_BIAS_NORMAL_OFFSET = 1
};
/// A bias in an engine's units. All of it is towards the light. Its size is fixed.
typedef struct gnomon_engine_bias {
  double depth;         ///< of the map's depth, 0..1
  double slope_factor;  ///< times the larger growth of depth over a texel, along the map's x or y
  double normal_world;  ///< along the normal, world units
  double units;         ///< `depth` in units of rasterizer states: steps of the map's format
} gnomon_engine_bias;
/// Translates the bias of a map into an engine's own: what keeps planes from shadowing themselves under a
/// kernel of this radius, texels. `map`: index in the plan. `way`: GNOMON_BIAS_RASTERIZER or
/// GNOMON_BIAS_NORMAL_OFFSET. `depth_bits`: of a normalized integer, 1..32; 0: single precision. `depth` is
/// right where the map's w is constant: parallel light without a warp. Elsewhere it holds in the middle of
/// the map. A map without a depth range, as foreign ones are: all 0.
GNOMON_EXPERIMENTAL int32_t gnomon_translate_bias(const gnomon_plan* plan, int32_t map, int32_t way,
                                                  double kernel_radius_texels, int32_t depth_bits,
                                                  gnomon_engine_bias* bias, const char** invalid_field);

/// Offset of the texel grid in a frame, x and y in (-0.5, 0.5) texels. Offsets are a lattice of 64 points.
/// Any GNOMON_JITTER_FRAMES frames in a row hold all of it. Refuses NULL.
GNOMON_EXPERIMENTAL int32_t gnomon_jitter_texels(uint32_t frame, double offset[2]);
/// Moves the texel grid of every map of a plan by `offset` texels across the light, each clamped to half a
/// texel. The maps serve the same points and casters. Add 0.5 to gnomon_plan_options::filter_texels before
/// planning, so that no kernel leaves its map. The next frame cannot reuse moved maps.
GNOMON_EXPERIMENTAL int32_t gnomon_jitter(gnomon_plan* plan, const double offset[2],
                                          const char** invalid_field);

/// The decision of gnomon_hold_sun. Its size is fixed.
typedef struct gnomon_held_sun {
  double direction[3];    ///< to plan with: the held one, or the sun's own, bit for bit
  double error_pixels;    ///< largest error of the points that were read, screen pixels
  double turned_pixels;   ///< error of the point that turned it, above the bound; 0: none did
  int64_t points_capped;  ///< points that the light grazes more than least_light_sine: not evaluated
} gnomon_held_sun;
/// Keeps the direction of a sun that turns until a shadow edge could lie more than `most_pixels` from its
/// true place. Then takes the sun's own. Pages of fit stable keep their texels under a held direction.
/// `view`: with points; without, the sun is not held. `held`: the direction of the last frame. `casters`: one
/// box round all casters. `most_pixels`: >= 0; 0 never holds, 0.25 is below what a texel of m = 1 can show.
/// `least_light_sine`: as gnomon_page_options::least_light_sine, 0..1; 0.05 suits most scenes.
GNOMON_EXPERIMENTAL int32_t gnomon_hold_sun(const gnomon_view* view, const double held[3],
                                            const double sun[3], const double casters[6], double most_pixels,
                                            double least_light_sine, gnomon_held_sun* result,
                                            const char** invalid_field);

/// Where maps lie in one texture; no two share a texel. Its size is fixed.
typedef struct gnomon_atlas {
  int32_t width, height;                     ///< texels; 0: there is no map, or the maps do not fit
  gnomon_texel_rect place[GNOMON_MAX_MAPS];  ///< by index of the map in the plan
  int32_t count;                             ///< maps placed: all of the plan's, or none
  int32_t reserved;                          ///< 0
  double efficiency;                         ///< texels of the maps over those of the texture, in 0..1
} gnomon_atlas;
/// Places the maps of a plan into a texture of `width` times `height` texels. Both 0: into the smallest one
/// whose sides are powers of two, which any plan fits into. gnomon_atlas::count is 0 where they do not fit.
/// The same sizes give the same places.
GNOMON_EXPERIMENTAL int32_t gnomon_pack_atlas(const gnomon_plan* plan, int32_t width, int32_t height,
                                              gnomon_atlas* atlas, const char** invalid_field);
/// Writes the matrix from the clip space of a map to its part of the atlas: gnomon_texture_from_clip with the
/// place of `map` taken in. Draw the map with its place as the viewport.
GNOMON_EXPERIMENTAL int32_t gnomon_atlas_from_clip(const gnomon_atlas* atlas,
                                                   const gnomon_clip_space* clip_space, int32_t map,
                                                   double atlas_from_clip[16], const char** invalid_field);

// ---------------------------------------------------------------- measure

/// How an error is sampled.
typedef struct gnomon_measure_options {
  uint32_t size;  ///< set by gnomon_measure_options_default
  int32_t map;    ///< index of the one map whose points count; -1, the default: all
  int32_t
      columns;   ///< pixels across, 1..65536; default 64. Not read where the view has points, as the next two
  int32_t rows;  ///< pixels down, 1..65536; default 64
  int32_t depths;    ///< depths along each pixel's ray, 1..65536; default 64
  int32_t reserved;  ///< 0
} gnomon_measure_options;
/// Fills in defaults. `size`: sizeof *options.
GNOMON_API int32_t gnomon_measure_options_default(gnomon_measure_options* options, uint32_t size);

/// The aliasing error m, screen pixels per texel, over many points. Above 1, texels show.
typedef struct gnomon_stats {
  uint32_t size;              ///< set by gnomon_stats_default
  uint32_t reserved;          ///< 0
  double p50;                 ///< half of the points stay below
  double p95;                 ///< 95 % of the points stay below
  double max;                 ///< largest
  double mean;                ///< mean: orders techniques by their misclassified pixels best
  double share_undersampled;  ///< share of the points above 1, in 0..1
  double storage;             ///< texels per screen pixel for an error of 1 everywhere
  int64_t samples;            ///< points that counted
  int64_t outside;            ///< points of visible receivers that no map holds
} gnomon_stats;
/// Fills in zeros. `size`: sizeof *stats.
GNOMON_API int32_t gnomon_stats_default(gnomon_stats* stats, uint32_t size);

/// Measures the perspective error of a plan over what the view sees. It samples the view's points, else a
/// grid of pixels and depths in the receivers' boxes. Matrices of another planner serve as well: in a plan of
/// one's own, set status to GNOMON_OK, maps, map_size, map_room, map_count, clip_space and selection.
/// `options`: NULL for defaults. Plans without maps give zeros.
GNOMON_API int32_t gnomon_measure(const gnomon_plan* plan, const gnomon_view* view, const gnomon_scene* scene,
                                  const gnomon_measure_options* options, gnomon_stats* stats,
                                  const char** invalid_field);

enum {
  GNOMON_POINT_OK = 0,           ///< the error is known
  GNOMON_POINT_OUTSIDE = 1,      ///< the map does not hold the point: m is infinite
  GNOMON_POINT_FACES_AWAY = 2,   ///< the surface is turned from the light or the eye
  GNOMON_POINT_UNDETERMINED = 3  ///< edge-on to both
};
/// The aliasing error at one point, screen pixels per texel. Its size is fixed.
typedef struct gnomon_point_error {
  int32_t status;       ///< GNOMON_POINT_OK and others: whether the fields hold
  int32_t reserved;     ///< 0
  double m_max, m_min;  ///< longest and shortest extent of a texel
  double m_s, m_t;      ///< extent along the map's x and y
  double m_area;        ///< square root of a texel's area in pixels
  double anisotropy;    ///< m_max over m_min
  double perspective_max, perspective_s, perspective_t;  ///< the same on a surface that faces the half vector
  double projection;                                     ///< cos(normal, eye) over cos(normal, light)
} gnomon_point_error;
/// Measures at each of `count` points, world space. `normals`: unit, as many; NULL: the perspective part
/// alone. The map may be a foreign one.
GNOMON_API int32_t gnomon_measure_points(const gnomon_map* map, const gnomon_camera* camera,
                                         const double* points, const double* normals, int64_t count,
                                         gnomon_point_error* errors, const char** invalid_field);

/// Finds what lies between any point of space and the light, as a map finds it: by rays. `point`: x, y, z,
/// world space. Returns the distance along the light from there to the occluder nearest the light, world
/// units. Negative: that one lies beyond the point. -infinity, and not a number: there is none. `scene`:
/// gnomon_shadow_picture::occluder_scene. The search may make other calls of gnomon. It must return: no
/// exception and no jump may leave it.
typedef double (*gnomon_occluder_search)(const void* scene, const double point[3]);

/// A shadow as a camera sees it: of other maps, of the last frame, or of rays.
typedef struct gnomon_shadow_picture {
  uint32_t size;                ///< set by gnomon_shadow_picture_default
  uint32_t reserved;            ///< 0
  const gnomon_camera* camera;  ///< its width and height are those of both pictures; required; default NULL
  /// A number for each pixel, rows from top to bottom: 1 lit .. 0 in shadow. Not counted: negative numbers,
  /// numbers above 1, not a number. Columns go along cross(forward, up): those of a left-handed world from
  /// right to left. Required; default NULL.
  const float* mask;
  /// View depths of the surfaces, as many, world units. No surface: 0, less, infinity, not a number.
  /// Required; default NULL.
  const float* view_depths;
  int64_t pixel_count;  ///< entries of each: the camera's width times height
  // Expected errors alone read what follows.
  /// Half side of the box of texels whose comparisons the filter averages. 0, the default, less, and not a
  /// number: one texel, hard comparison. More than 33 count as 33.
  double kernel_texels;
  /// For each dark pixel the distance along the light from the surface to the occluder nearest the light,
  /// world units. A bias that is longer lights the surface. Negative, not a number: not known there. NULL,
  /// the default: not known, and errors of the bias do not count. Not read beside occluder_search.
  const float* occluder_distances;
  /// Searches what casts shadows in the picture's light. With it errors are those of the maps' own
  /// comparisons, also where the picture does not show the middle of a texel. NULL, the default: none.
  gnomon_occluder_search occluder_search;
  const void* occluder_scene;  ///< handed to it; default NULL
  /// Beside occluder_search: normals of the surfaces, unit, towards the viewer, three numbers for each pixel.
  /// Zero there, and NULL, the default: from view_depths.
  const float* normals;
} gnomon_shadow_picture;
/// Fills in defaults. `size`: sizeof *picture.
GNOMON_EXPERIMENTAL int32_t gnomon_shadow_picture_default(gnomon_shadow_picture* picture, uint32_t size);

/// The pixels that a plan will get wrong. Its size is fixed.
typedef struct gnomon_wrong_pixels {
  double wrong;    ///< lit and dark pixels that are taken for each other; no whole number
  double counted;  ///< pixels that have a surface, and are lit or dark
  double share;    ///< wrong over counted, in 0..1; 0 where none counts
} gnomon_wrong_pixels;
/// Counts the pixels that comparisons in the plan's maps will misclassify, without drawing them. A plan
/// without maps gets all that is dark wrong. Foreign matrices serve as in gnomon_measure: where light_world
/// is not the light of a matrix, the matrix's own counts. Time grows with the pixels.
///
/// With occluder_search each pixel is compared with what lies on the light's ray through the middle of its
/// texel, on the plane of its surface. Neighbours that read one texel search it once.
///
/// Without, each pixel takes the shadow that the picture shows at the middle of its texel, where the texel
/// meets the surface. Light that the plan's bias lets in counts where occluder_distances are known. Shadows
/// narrower than a pixel count less than they should: the picture should be as fine as the texels.
GNOMON_EXPERIMENTAL int32_t gnomon_expected_error(const gnomon_plan* plan,
                                                  const gnomon_shadow_picture* picture,
                                                  gnomon_wrong_pixels* pixels, const char** invalid_field);
/// Writes points of the surfaces along the shadow's edges, world space, three doubles each. At most `room` of
/// them, evenly over the picture; `*written` is how many. A plan for them (gnomon_view::points) has its
/// texels where they show. Give such a plan visible points as well: maps reach no farther than its points.
GNOMON_EXPERIMENTAL int32_t gnomon_shadow_edge_points(const gnomon_shadow_picture* picture, double* points,
                                                      int64_t room, int64_t* written,
                                                      const char** invalid_field);

// ---------------------------------------------------------------- pages

/// Bits of gnomon_page_history::feedback, for policies that read the rendered image.
enum {
  GNOMON_SHADOW_EDGE = 1,     ///< a shadow edge lies at the point or next to it: policies edges, picture
  GNOMON_SHADOW_CHANGED = 2,  ///< the last refinement changed whether the point is lit: policy queried
  GNOMON_DEPTH_EDGE = 4       ///< view depths jump at the point or next to it: policy tiled
};
/// Options of gnomon_plan_pages. Every default suits most scenes.
typedef struct gnomon_page_options {
  uint32_t size;   ///< set by gnomon_page_options_default
  int32_t policy;  ///< GNOMON_PAGE_POLICIES: how fine the page of a point is; default resolution
  /// The base of the levels; NULL, the default: the defaults with warp none, as levels follow the view
  /// already. With fit stable, pages keep their place in the world under camera motion.
  const gnomon_plan_options* plan;
  int32_t page_texels;  ///< texels along each side that a page serves: 64, 128, the default, or 256
  int32_t capacity;     ///< pages of the pool, 1..2^20; default 4096. Too few: all levels coarsen evenly
  double target_m;      ///< error along either side of a texel that no visible point exceeds; default 1
  double share;         ///< share of the visible points that must meet it, in (0, 1]; default 1
  int32_t levels_per_octave;  ///< steps in which texels halve, 1..4; default 3
  int32_t trials;             ///< positions of the levels' sizes that are tried, 1..16; default 1
  int32_t virtual_texels;     ///< largest side of a level, texels, page_texels..2^26; default 2^22
  int32_t fallback;           ///< flag: the coarsest level is resident everywhere; default 0
  double reach_texels;        ///< room round each point, texels of its level, 0..page_texels; default 0
  double least_light_sine;  ///< sine of the angle to the light below which normals do not count; default 0.05
} gnomon_page_options;
/// Fills in defaults. `size`: sizeof *options.
GNOMON_EXPERIMENTAL int32_t gnomon_page_options_default(gnomon_page_options* options, uint32_t size);

/// One resident page. Its size is fixed.
typedef struct gnomon_page {
  uint32_t level;       ///< index of its level
  int32_t column, row;  ///< of the level's virtual map, from ndc (-1, -1)
  uint32_t slot;        ///< place in the pool, below the capacity
  uint32_t points;      ///< visible points that it was opened for
} gnomon_page;

/// A page plan: levels, and resident pages. It refers to the memory of the call, which must live as long.
typedef struct gnomon_page_plan {
  uint32_t size;               ///< set by gnomon_page_plan_default
  int32_t status;              ///< as the call returned
  gnomon_omission* omissions;  ///< in: where omissions are written, or NULL, the default
  int32_t omission_room;       ///< in: entries of omissions
  int32_t omission_count;      ///< omissions; may exceed omission_room
  const gnomon_page* pages;    ///< resident pages, coarsest level first; in the memory of the call
  const uint32_t* table;       ///< hash table over the pages, as shaders/library reads it; in the same memory
  const void* memory;          ///< the memory of the call; other calls read it
  int64_t page_count;          ///< resident pages
  int64_t table_count;         ///< entries of table
  int32_t level_count;         ///< levels that have pages, coarsest first: gnomon_page_level
  int32_t policy;              ///< GNOMON_PAGE_POLICIES
  int32_t page_texels;         ///< texels that a page serves along each side
  int32_t border_texels;       ///< texels round them in the page's slot, which hold the filter's kernel
  int32_t capacity;            ///< slots of the pool
  int32_t reserved;            ///< 0
  double origin[3];            ///< what clip_from_camera_relative is relative to, world space
  double light_direction[3];   ///< unit, the way the light travels
  gnomon_clip_space clip_space;  ///< of all matrices of the plan
  double target_m;  ///< error that levels were chosen for; larger than requested where the pool is small
  int64_t points;   ///< visible points that pages serve
  int64_t points_outside;  ///< beside all receivers or beyond the light's range: lit
  int64_t points_coarser;  ///< left to a coarser level by gnomon_page_options::share
  int64_t points_capped;   ///< that the deepest level does not suffice for
} gnomon_page_plan;
/// Fills in defaults: no page. `size`: sizeof *plan.
GNOMON_EXPERIMENTAL int32_t gnomon_page_plan_default(gnomon_page_plan* plan, uint32_t size);

/// Report of the last frame's image, for policies that read it.
typedef struct gnomon_page_history {
  uint32_t size;      ///< set by gnomon_page_history_default
  uint32_t reserved;  ///< 0
  const gnomon_page_plan*
      last;  ///< the plan of the last frame, in other memory than the new one; NULL, the default: none
  const uint8_t* feedback;  ///< bits of each of gnomon_view::points; NULL, the default: nothing was reported
  int64_t feedback_count;   ///< entries of feedback
} gnomon_page_history;
/// Fills in defaults. `size`: sizeof *history.
GNOMON_EXPERIMENTAL int32_t gnomon_page_history_default(gnomon_page_history* history, uint32_t size);

/// Bytes of memory that gnomon_plan_pages needs for a pool of this capacity and so many visible points; 0
/// where either is out of range. Without points, some ten thousand suffice for samples of the receivers'
/// boxes.
GNOMON_EXPERIMENTAL int64_t gnomon_page_memory(int32_t capacity, int64_t points);
/// Chooses the pages that the view's points need. `memory`: `bytes` bytes, at least gnomon_page_memory,
/// aligned to 16. They hold the plan's lists until the next call that gets them. `options`, `history`: NULL
/// for none.
GNOMON_EXPERIMENTAL int32_t gnomon_plan_pages(const gnomon_view* view, const gnomon_light* light,
                                              const gnomon_scene* scene, const gnomon_page_options* options,
                                              const gnomon_page_history* history, void* memory, int64_t bytes,
                                              gnomon_page_plan* plan, const char** invalid_field);
/// Copies a level below level_count: width and height are those of the whole virtual map. `map`:
/// gnomon_map_default.
GNOMON_EXPERIMENTAL int32_t gnomon_page_level(const gnomon_page_plan* plan, int32_t level, gnomon_map* map,
                                              const char** invalid_field);
/// The page of this index as a map of its own, to draw it and to cull its casters.
GNOMON_EXPERIMENTAL int32_t gnomon_page_map(const gnomon_page_plan* plan, int64_t page, gnomon_map* map,
                                            const char** invalid_field);
/// Finds the page that serves each of `count` points, world space: its index, or -1.
GNOMON_EXPERIMENTAL int32_t gnomon_page_select(const gnomon_page_plan* plan, const double* points,
                                               int64_t count, int32_t* indices, const char** invalid_field);
/// Measures the error in the pages that serve what the view sees. `texels_per_pixel`: pages without borders
/// over the pixels of the camera; may be NULL. Otherwise as gnomon_measure.
GNOMON_EXPERIMENTAL int32_t gnomon_measure_pages(const gnomon_page_plan* plan, const gnomon_view* view,
                                                 const gnomon_scene* scene,
                                                 const gnomon_measure_options* options, gnomon_stats* stats,
                                                 double* texels_per_pixel, const char** invalid_field);
/// gnomon_expected_error in the pages that serve the points of the picture. A point without a page is drawn
/// as lit.
GNOMON_EXPERIMENTAL int32_t gnomon_expected_page_error(const gnomon_page_plan* plan,
                                                       const gnomon_shadow_picture* picture,
                                                       gnomon_wrong_pixels* pixels,
                                                       const char** invalid_field);

/// One slot of a pool that keeps pages from frame to frame: set it to zeros, and then leave it to
/// gnomon_keep_pages. Its size is fixed.
typedef struct gnomon_page_slot {
  double clip_from_world[16];  ///< of the page that was drawn into it
  int32_t texels;              ///< along each side
  int32_t reserved;            ///< 0
  uint64_t used;               ///< count of the last call that used it; 0: it holds nothing
  uint64_t behind;             ///< not 0: a moving caster touched it since those were last drawn
} gnomon_page_slot;
/// Where a page of a plan lies in a pool. Its size is fixed.
typedef struct gnomon_kept_page {
  uint32_t slot;        ///< of the pool, in place of gnomon_page::slot
  uint8_t draw;         ///< flag: the page is to be drawn
  uint8_t compose;      ///< flag: only its moving casters are, over the static ones
  uint8_t reserved[2];  ///< 0
} gnomon_kept_page;
/// Entries of the table that gnomon_keep_pages needs; 0 where `slots` is out of range.
GNOMON_EXPERIMENTAL int64_t gnomon_page_table_size(int32_t slots);
/// Finds the pages that a pool still holds, and a slot for each of the others. `moved`: boxes of casters that
/// changed since the last call, where they were and where they are. `slots`: the pool, `slot_count` of them,
/// at least one for each page. `table`: gnomon_page_table_size entries. `kept`: one for each page. `*drawn`:
/// pages to draw; may be NULL.
GNOMON_EXPERIMENTAL int32_t gnomon_keep_pages(const gnomon_page_plan* plan, const double* moved,
                                              int64_t moved_count, gnomon_page_slot* slots,
                                              int32_t slot_count, uint32_t* table, gnomon_kept_page* kept,
                                              int64_t* drawn, const char** invalid_field);

// ---------------------------------------------------------------- many lights

/// One light of gnomon_plan_lights.
typedef struct gnomon_light_request {
  uint32_t size;              ///< set by gnomon_light_request_default
  int32_t changed;            ///< flag: its casters moved, or its maps are lost; default 0
  const gnomon_light* light;  ///< required; default NULL
  double weight;              ///< counts its error so many times, >= 0; default 1
  double draws;               ///< draw calls of all its maps, >= 0; default 0. Read with millisecond_budget
  double triangles;           ///< triangles of all its maps, >= 0; default 0. The same
} gnomon_light_request;
/// Fills in defaults. `size`: sizeof *request.
GNOMON_EXPERIMENTAL int32_t gnomon_light_request_default(gnomon_light_request* request, uint32_t size);

/// Options of gnomon_plan_lights. Every default suits most scenes.
typedef struct gnomon_light_options {
  uint32_t size;                    ///< set by gnomon_light_options_default
  int32_t page_budget;              ///< most pages of all maps together, >= 0; 0, the default: no such budget
  const gnomon_plan_options* plan;  ///< of the plans of all lights; NULL, the default: the defaults
  int32_t pool_width, pool_height;  ///< texels of the pool, multiples of most_size, up to 2^16; default 4096
  int64_t texel_budget;             ///< most texels of all maps together, at least 1; default: the pool's
  int32_t page_texels;              ///< side of a page, a power of two up to most_size; default 128
  int32_t least_size;               ///< side of the smallest maps, texels, a power of two; default 64
  int32_t most_size;          ///< side of the largest maps, texels, a power of two up to 16384; default 1024
  int32_t most_frames;        ///< most frames from one drawing of a light to the next, 1..64; default 8
  double millisecond_budget;  ///< most milliseconds per frame by the costs, >= 0; 0, the default: none
  double cost_per_map, cost_per_megatexel;          ///< milliseconds, >= 0; default 0
  double cost_per_kilodraw, cost_per_megatriangle;  ///< milliseconds, >= 0; default 0
  double enough_m;    ///< error that suffices, screen pixels per texel, >= 0; 0, the default: none
  double full_share;  ///< share of the picture refreshed every frame, in (0, 1]; default 1/64
  double keep_gain;   ///< with a history: how much a light's last size is favoured, >= 1; default 1.5
} gnomon_light_options;
/// Fills in defaults. `size`: sizeof *options.
GNOMON_EXPERIMENTAL int32_t gnomon_light_options_default(gnomon_light_options* options, uint32_t size);

enum {
  GNOMON_LIGHT_MAPPED = 0,            ///< it has maps of at least least_size
  GNOMON_LIGHT_BELOW_LEAST_SIZE = 1,  ///< it has smaller maps: the budget does not suffice
  GNOMON_LIGHT_WITHOUT_RECEIVER = 2,  ///< no map: it lights no receiver in view
  GNOMON_LIGHT_WITHOUT_CASTER = 3     ///< no map: nothing within its range casts shadows
};
/// The maps of one light in the pool.
typedef struct gnomon_light_maps {
  uint32_t size;                             ///< written by the call: gnomon_light_plan::light_size
  int32_t outcome;                           ///< GNOMON_LIGHT_MAPPED and others
  int32_t texels;                            ///< along each side of each map; 0: none
  int32_t map_count;                         ///< maps that have a place
  gnomon_texel_rect place[GNOMON_MAX_MAPS];  ///< in the pool, by index of the map in the light's plan
  double share;                              ///< part of the picture that the light may light, in 0..1
  double m;                                  ///< mean error over that part, screen pixels per texel
  int32_t frames;                            ///< from one drawing to the next
  int32_t due;                               ///< flag: plan and draw its maps in this frame
} gnomon_light_maps;

/// A plan of many lights. Set the fields marked "in" before the call; the others are results.
typedef struct gnomon_light_plan {
  uint32_t size;              ///< set by gnomon_light_plan_default
  uint32_t light_size;        ///< in: sizeof(gnomon_light_maps)
  gnomon_light_maps* lights;  ///< in: where the maps of each light are written, in the order of the requests
  int64_t light_room;         ///< in: entries of lights, at least as many as requests
  int64_t light_count;        ///< lights; 0 where the call was refused
  int32_t status;             ///< as the call returned
  int32_t invalid_light;      ///< index of the light that was refused; -1: of none
  int32_t pool_width, pool_height;  ///< texels
  int64_t texels;                   ///< of all maps
  int64_t due_texels;               ///< of the maps that are due
  int64_t pages;                    ///< of all maps; 0 without a page budget
  double milliseconds;              ///< by the costs, per frame in the mean
  double due_milliseconds;          ///< the same, of what is due in this frame
  double error;                     ///< sum of weight times share times m, which the sizes minimise
  int32_t mapped;                   ///< lights that have maps
  int32_t due;                      ///< of them, to be planned and drawn in this frame
  int32_t repacked;                 ///< flag: all maps were placed again
  int32_t reserved;                 ///< 0
} gnomon_light_plan;
/// Fills in defaults: no room, no light. `size`: sizeof *plan.
GNOMON_EXPERIMENTAL int32_t gnomon_light_plan_default(gnomon_light_plan* plan, uint32_t size);

/// State of gnomon_plan_lights from frame to frame. Keep one per pool and camera.
typedef struct gnomon_light_history gnomon_light_history;
/// A new history for up to `lights` lights, or NULL where there is no memory or the number is out of range.
GNOMON_EXPERIMENTAL gnomon_light_history* gnomon_light_history_create(int64_t lights);
/// Frees the history; NULL does nothing.
GNOMON_EXPERIMENTAL void gnomon_light_history_destroy(gnomon_light_history* history);
/// Exchanges what is remembered of two lights: where their order changes. Indices out of range do nothing.
GNOMON_EXPERIMENTAL void gnomon_light_history_swap(gnomon_light_history* history, int64_t a, int64_t b);
/// Forgets one light: where another one takes its index. An index out of range does nothing.
GNOMON_EXPERIMENTAL void gnomon_light_history_forget(gnomon_light_history* history, int64_t light);

/// Bytes of memory that gnomon_plan_lights needs for so many lights and visible points; 0 where either is out
/// of range.
GNOMON_EXPERIMENTAL int64_t gnomon_light_memory(int64_t lights, int64_t points);
/// Divides the texels of one pool among lights, and chooses which of them are due. `requests`: `count` of
/// them, `request_size` bytes each. `memory`: working memory, `bytes` bytes, at least gnomon_light_memory,
/// aligned to 16. `options`, `history`: NULL for none. Plan each light that is due by gnomon_make_plan with
/// gnomon_light_plan_options.
GNOMON_EXPERIMENTAL int32_t gnomon_plan_lights(const gnomon_view* view, const gnomon_light_request* requests,
                                               uint32_t request_size, int64_t count,
                                               const gnomon_scene* scene, const gnomon_light_options* options,
                                               gnomon_light_history* history, void* memory, int64_t bytes,
                                               gnomon_light_plan* plan, const char** invalid_field);
/// Options for the plan of one light: maps of its size. `plan_options` comes from
/// gnomon_plan_options_default.
GNOMON_EXPERIMENTAL int32_t gnomon_light_plan_options(const gnomon_light_options* options,
                                                      const gnomon_light_maps* maps,
                                                      gnomon_plan_options* plan_options,
                                                      const char** invalid_field);
/// A camera that sees all that a local light can light, for maps that serve several frames. For a directional
/// light, `camera` itself. `round` comes from gnomon_camera_default.
GNOMON_EXPERIMENTAL int32_t gnomon_camera_round(const gnomon_light* light, const gnomon_camera* camera,
                                                gnomon_camera* round, const char** invalid_field);
/// The pool as the atlas of one light's maps, for gnomon_atlas_from_clip.
GNOMON_EXPERIMENTAL int32_t gnomon_light_atlas(const gnomon_light_plan* plan, int64_t light,
                                               gnomon_atlas* atlas, const char** invalid_field);

/// Lists of the lights that reach into each cluster of the view: a tile of pixels times a slice of depth. Set
/// the fields marked "in" before the call; the others are results.
typedef struct gnomon_light_clusters {
  uint32_t size;         ///< set by gnomon_light_clusters_default
  int32_t tile_pixels;   ///< in: side of a tile, pixels, at least 1; default 64. Also a result: larger where
                         ///< the lists hold no finer ones
  int32_t depth_slices;  ///< in: parts of the view depth, 1..256; default 48
  int32_t status;        ///< as the call returned
  uint32_t* begin;       ///< in: where each cluster's list begins; required
  uint32_t* lights;      ///< in: the lists, indices of lights in ascending order; required
  int64_t begin_room;    ///< in: entries of begin: gnomon_cluster_count + 1 suffice, 2 are required
  int64_t light_room;    ///< in: entries of lights, at least as many as lights. More: finer clusters
  int32_t columns, rows, slices;  ///< clusters along the image's sides and along depth
  int32_t orthographic;           ///< flag of the camera
  /// Slice of a surface: floor(depth_scale * log2(view depth) + depth_offset), of the view depth itself for
  /// an orthographic camera, clamped to 0..slices - 1.
  double depth_scale;
  double depth_offset;  ///< see depth_scale
  int64_t light_count;  ///< entries of lights that are used
} gnomon_light_clusters;
/// Fills in defaults. `size`: sizeof *clusters.
GNOMON_EXPERIMENTAL int32_t gnomon_light_clusters_default(gnomon_light_clusters* clusters, uint32_t size);
/// Clusters of an image with these options; 0 for what is out of range.
GNOMON_EXPERIMENTAL int64_t gnomon_cluster_count(const gnomon_camera* camera, int32_t tile_pixels,
                                                 int32_t depth_slices);
/// Bytes of memory that gnomon_cluster_lights needs for so many lights and entries of
/// gnomon_light_clusters::lights; 0 where either is out of range.
GNOMON_EXPERIMENTAL int64_t gnomon_cluster_memory(int64_t lights, int64_t light_room);
/// Lists the lights that can light a surface in each cluster. Shading by the lists gives the same light as
/// shading by all, as long as a light is zero beyond its range and cone. Cluster (column, row, slice) has the
/// lights lights[begin[i]] .. lights[begin[i + 1] - 1], i = (slice * rows + row) * columns + column, with row
/// 0 at the bottom of the image. Suns are in every list. `lights`: `count` of them, `light_size` bytes each.
/// `memory`: working memory, `bytes` bytes, at least gnomon_cluster_memory. Any lists fit: where they would
/// be too long, tiles become larger and slices fewer.
GNOMON_EXPERIMENTAL int32_t gnomon_cluster_lights(const gnomon_camera* camera, const gnomon_light* lights,
                                                  uint32_t light_size, int64_t count, void* memory,
                                                  int64_t bytes, gnomon_light_clusters* clusters,
                                                  const char** invalid_field);

#ifdef __cplusplus
}
#endif
#endif
