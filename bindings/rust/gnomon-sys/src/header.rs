// The structs, constants and calls of include/gnomon/c/gnomon.h. Written by bindings/layout.py.

/// done; of a plan: there are maps to draw
pub const GNOMON_OK: i32 = 0;
/// of a plan: no receiver in view, no map, everything in view is lit
pub const GNOMON_NOTHING_VISIBLE: i32 = 1;
/// of a plan: receivers in view, but nothing can shadow them: no map
pub const GNOMON_NO_CASTER: i32 = 2;
/// refused: `*invalid_field` names what is wrong
pub const GNOMON_INVALID_INPUT: i32 = 3;
/// of _create() and _resize() alone: there is no memory
pub const GNOMON_OUT_OF_MEMORY: i32 = 4;
/// maps of one plan
pub const GNOMON_MAX_MAPS: i32 = 8;
/// planes round what casts into a map
pub const GNOMON_MAX_CULL_PLANES: i32 = 32;
/// planes round a map's share of the receivers
pub const GNOMON_MAX_SELECT_PLANES: i32 = 4;
/// planes that get a map of their own
pub const GNOMON_MAX_WARP_PLANES: i32 = 3;
/// omissions that a plan lists; more are counted alone
pub const GNOMON_MAX_OMISSIONS: i32 = 32;
/// cameras of one plan
pub const GNOMON_MAX_VIEWS: i32 = 8;
/// lights of one gnomon_plan_lights
pub const GNOMON_MAX_LIGHTS: i32 = 4096;
/// numbers that a shape is set by
pub const GNOMON_SHAPE_PARAMETERS: i32 = 15;
/// bins of gnomon_visible_depths
pub const GNOMON_DEPTH_BINS: i32 = 352;
/// floats of a shader block
pub const GNOMON_SHADER_BLOCK_FLOATS: i32 = 460;
/// frames after which gnomon_jitter_texels repeats
pub const GNOMON_JITTER_FRAMES: i32 = 64;
/// gnomon_plan_options::warp, gnomon_map::warp
pub const GNOMON_WARPS: i32 = 0;
/// gnomon_plan_options::warp_shape, gnomon_map::shape
pub const GNOMON_SHAPES: i32 = 1;
/// gnomon_plan_options::fit
pub const GNOMON_FITS: i32 = 2;
/// gnomon_plan_options::split_scheme
pub const GNOMON_SPLITS: i32 = 3;
/// gnomon_plan_options::split_partition
pub const GNOMON_PARTITIONS: i32 = 4;
/// gnomon_plan_options::split_selection, gnomon_plan::selection
pub const GNOMON_SELECTIONS: i32 = 5;
/// gnomon_plan_options::warp_objective
pub const GNOMON_OBJECTIVES: i32 = 6;
/// bits of gnomon_plan_options::prune: an entry's bit is 1 << index
pub const GNOMON_PRUNE_RULES: i32 = 7;
/// gnomon_page_options::policy
pub const GNOMON_PAGE_POLICIES: i32 = 8;
/// what calls return
pub const GNOMON_STATUSES: i32 = 9;
/// an index that lets the library choose, where the field's comment says so
pub const GNOMON_DEFAULT: i32 = -1;
/// what gnomon_find returns for a name that is not there; refused as an option
pub const GNOMON_UNKNOWN: i32 = -2;
/// parallel light: `direction`
pub const GNOMON_DIRECTIONAL: i32 = 0;
/// a cone: `position`, `direction`, `outer_radians`, `range`
pub const GNOMON_SPOT: i32 = 1;
/// all directions: `position`, `range`
pub const GNOMON_POINT: i32 = 2;
/// GNOMON_RANGE_RECEIVERS; for fit stable, and cascades with a cadence, depths up to the farthest receiver
pub const GNOMON_RANGE_AUTOMATIC: i32 = 0;
/// depths that hold receivers in view
pub const GNOMON_RANGE_RECEIVERS: i32 = 1;
/// all depths of the camera
pub const GNOMON_RANGE_CAMERA: i32 = 2;
/// a: depth_begin, b: depth_end
pub const GNOMON_CASCADE_WITHOUT_RECEIVER: i32 = 0;
/// a: depth_begin, b: depth_end
pub const GNOMON_CASCADE_WITHOUT_CASTER: i32 = 1;
/// the camera's depths were cut: a: depth_begin, b: depth_end
pub const GNOMON_DEPTH_WITHOUT_RECEIVER: i32 = 2;
/// gnomon_view::depths shows nothing there: a: depth_begin, b: depth_end
pub const GNOMON_DEPTH_NOT_VISIBLE: i32 = 3;
/// a: objective with the warp over that without; infinite: it fits none
pub const GNOMON_WARP_WITHOUT_GAIN: i32 = 4;
/// fit stable takes no warp
pub const GNOMON_WARP_IN_STABLE_FIT: i32 = 5;
/// of a partition; a: depth_begin, b: depth_end
pub const GNOMON_PART_WITHOUT_CASTER: i32 = 6;
/// a: objective of the parts over that of one map
pub const GNOMON_PARTITION_WITHOUT_GAIN: i32 = 7;
/// fit stable takes no other partition
pub const GNOMON_PARTITION_IN_STABLE_FIT: i32 = 8;
/// of a local light
pub const GNOMON_FACE_WITHOUT_RECEIVER: i32 = 9;
/// of a local light
pub const GNOMON_FACE_WITHOUT_CASTER: i32 = 10;
/// a smaller map suffices; a: bound of m at full size, b: now
pub const GNOMON_RESOLUTION_WITHOUT_GAIN: i32 = 11;
/// nearer than depth a on the map's axis nothing casts; b: casters
pub const GNOMON_DEPTH_NEAR_LIGHT: i32 = 12;
/// a: which, GNOMON_IGNORED_PARTITION and others
pub const GNOMON_OPTION_IGNORED: i32 = 13;
/// of gnomon_plan_views; a: index of the camera
pub const GNOMON_VIEW_WITHOUT_RECEIVER: i32 = 14;
/// the pool is too small; a: requested error, b: planned error
pub const GNOMON_PAGES_COARSENED: i32 = 15;
/// by gnomon_page_options::share; a: how many
pub const GNOMON_POINTS_LEFT_COARSER: i32 = 16;
/// the deepest level does not suffice; a: how many
pub const GNOMON_POINTS_BEYOND_LEVELS: i32 = 17;
/// a: error with the shape over that without
pub const GNOMON_SHAPE_WITHOUT_GAIN: i32 = 18;
/// a: index in warp_planes
pub const GNOMON_PLANE_WITHOUT_RECEIVER: i32 = 19;
/// a: index in warp_planes
pub const GNOMON_PLANE_WITHOUT_CASTER: i32 = 20;
/// maps of warp_planes serve all of it; a: depth_begin, b: depth_end
pub const GNOMON_CASCADE_ON_PLANES: i32 = 21;
/// no map is left for a slice; a: slices, b: split_face_slices
pub const GNOMON_FACES_LESS_DIVIDED: i32 = 22;
/// receivers nearer than a to the light are lit; b: their boxes
pub const GNOMON_RECEIVER_NEAR_LIGHT: i32 = 23;
/// the next map serves it with the same texels; a, b: depths
pub const GNOMON_CASCADE_WITHOUT_GAIN: i32 = 24;
/// split_partition
pub const GNOMON_IGNORED_PARTITION: i32 = 0;
/// split_scheme
pub const GNOMON_IGNORED_SPLIT_SCHEME: i32 = 1;
/// split_overlap
pub const GNOMON_IGNORED_SPLIT_OVERLAP: i32 = 2;
/// gnomon_view::depths
pub const GNOMON_IGNORED_VISIBLE_DEPTHS: i32 = 3;
/// resolution_texel_budget
pub const GNOMON_IGNORED_TEXEL_BUDGET: i32 = 4;
/// the history
pub const GNOMON_IGNORED_HISTORY: i32 = 5;
/// split_selection
pub const GNOMON_IGNORED_SELECTION: i32 = 6;
/// cadence_frames
pub const GNOMON_IGNORED_CADENCE: i32 = 7;
/// gnomon_view::points
pub const GNOMON_IGNORED_VISIBLE_POINTS: i32 = 8;
/// warp_shape
pub const GNOMON_IGNORED_SHAPE: i32 = 9;
/// warp_planes
pub const GNOMON_IGNORED_PLANES: i32 = 10;
/// gnomon_page_options::share
pub const GNOMON_IGNORED_PAGE_SHARE: i32 = 11;
/// gnomon_page_options::reach_texels
pub const GNOMON_IGNORED_PAGE_REACH: i32 = 12;
/// nothing was remembered of this cascade
pub const GNOMON_MAP_APPEARED: i32 = 0;
/// fit warped_stable: the view left the map
pub const GNOMON_MAP_REFITTED: i32 = 1;
/// texels per area of some surface point changed by more than 5 %
pub const GNOMON_DENSITY_JUMP: i32 = 2;
/// draw the whole map
pub const GNOMON_REUSE_NONE: i32 = 0;
/// every texel holds
pub const GNOMON_REUSE_IDENTICAL: i32 = 1;
/// `kept` holds once moved; draw the strips
pub const GNOMON_REUSE_SCROLLED: i32 = 2;
/// Rasterizer states: a constant, and a factor times the growth of depth over a texel (glPolygonOffset, Direct3D, Vulkan, Metal).
pub const GNOMON_BIAS_RASTERIZER: i32 = 0;
/// A constant, and a move along the normal before the look-up (three.js, Babylon.js, Unity, Godot).
pub const GNOMON_BIAS_NORMAL_OFFSET: i32 = 1;
/// the error is known
pub const GNOMON_POINT_OK: i32 = 0;
/// the map does not hold the point: m is infinite
pub const GNOMON_POINT_OUTSIDE: i32 = 1;
/// the surface is turned from the light or the eye
pub const GNOMON_POINT_FACES_AWAY: i32 = 2;
/// edge-on to both
pub const GNOMON_POINT_UNDETERMINED: i32 = 3;
/// a shadow edge lies at the point or next to it: policies edges, picture
pub const GNOMON_SHADOW_EDGE: i32 = 1;
/// the last refinement changed whether the point is lit: policy queried
pub const GNOMON_SHADOW_CHANGED: i32 = 2;
/// view depths jump at the point or next to it: policy tiled
pub const GNOMON_DEPTH_EDGE: i32 = 4;
/// it has maps of at least least_size
pub const GNOMON_LIGHT_MAPPED: i32 = 0;
/// it has smaller maps: the budget does not suffice
pub const GNOMON_LIGHT_BELOW_LEAST_SIZE: i32 = 1;
/// no map: it lights no receiver in view
pub const GNOMON_LIGHT_WITHOUT_RECEIVER: i32 = 2;
/// no map: nothing within its range casts shadows
pub const GNOMON_LIGHT_WITHOUT_CASTER: i32 = 3;

/// Boxes sorted into a tree, for scenes with hundreds of boxes and more. Gives the same plans as a list, bit for bit.
#[repr(C)]
pub struct gnomon_caster_set {
    hidden: [u8; 0],
    not_send: core::marker::PhantomData<*mut u8>,
}

/// Visible depths that are followed from frame to frame. Depths that come into view count at once, and those that leave it are given up slowly. Keep one per camera.
#[repr(C)]
pub struct gnomon_depth_tracker {
    hidden: [u8; 0],
    not_send: core::marker::PhantomData<*mut u8>,
}

/// State that plans carry from frame to frame. Keep one per camera and light.
#[repr(C)]
pub struct gnomon_history {
    hidden: [u8; 0],
    not_send: core::marker::PhantomData<*mut u8>,
}

/// State of gnomon_plan_lights from frame to frame. Keep one per pool and camera.
#[repr(C)]
pub struct gnomon_light_history {
    hidden: [u8; 0],
    not_send: core::marker::PhantomData<*mut u8>,
}

/// Finds what lies between any point of space and the light, as a map finds it: by rays. `point`: x, y, z, world space. Returns the distance along the light from there to the occluder nearest the light, world units. Negative: that one lies beyond the point. -infinity, and not a number: there is none. `scene`: gnomon_shadow_picture::occluder_scene. The search may make other calls of gnomon. It must return: no exception and no jump may leave it.
pub type gnomon_occluder_search = Option<unsafe extern "C" fn(scene: *const core::ffi::c_void, point: *const f64) -> f64>;

/// Clip space of matrices. All zero: OpenGL. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_clip_space {
    /// flag: depth after the division by w is 0..1 (Vulkan, Direct3D); 0: -1..1
    pub zero_to_one: i32,
    /// flag: depth grows towards the light, or the eye
    pub reversed_z: i32,
    /// flag: y grows downwards in clip space (Vulkan)
    pub y_down: i32,
    /// flag: the caller's world is left-handed (Unity, most Direct3D engines)
    pub left_handed: i32,
    /// flag: the first row in memory is at ndc y = 1 (Direct3D, Metal, WebGPU)
    pub first_row_at_y_max: i32,
    /// 0
    pub reserved: i32,
}

/// A viewing camera. View depth is positive forward: dot(point - position, forward).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_camera {
    /// set by gnomon_camera_default
    pub size: u32,
    /// flag: parallel projection; default 0
    pub orthographic: i32,
    /// eye, world space; default 0 0 0
    pub position: [f64; 3],
    /// view direction, any length above 0; default 0 0 -1
    pub forward: [f64; 3],
    /// any vector not along forward; along forward, a fixed axis is used; default 0 1 0
    pub up: [f64; 3],
    /// Edges of the image, left < right and bottom < top; defaults -1 and 1. Offsets per unit of view depth for a perspective camera, world units for an orthographic one.
    pub left: f64,
    /// Edges of the image, left < right and bottom < top; defaults -1 and 1. Offsets per unit of view depth for a perspective camera, world units for an orthographic one.
    pub right: f64,
    /// Edges of the image, left < right and bottom < top; defaults -1 and 1. Offsets per unit of view depth for a perspective camera, world units for an orthographic one.
    pub bottom: f64,
    /// Edges of the image, left < right and bottom < top; defaults -1 and 1. Offsets per unit of view depth for a perspective camera, world units for an orthographic one.
    pub top: f64,
    /// view depth where the image begins, above 0 for perspective; default 0.1
    pub near_depth: f64,
    /// view depth where it ends, above near_depth; infinity: sees without end; default 100
    pub far_depth: f64,
    /// pixels, 1..2^20; default 1920
    pub width: i32,
    /// pixels, 1..2^20; default 1080
    pub height: i32,
}

/// A light that casts shadows. Fields that its kind does not name are not read.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light {
    /// set by gnomon_light_default
    pub size: u32,
    /// GNOMON_DIRECTIONAL, the default, GNOMON_SPOT or GNOMON_POINT
    pub kind: i32,
    /// world space; default 0 0 0
    pub position: [f64; 3],
    /// the way the light travels, any length above 0; default 0 -1 0
    pub direction: [f64; 3],
    /// half angle of the cone, in (0, pi); default 0.5
    pub outer_radians: f64,
    /// world units, above 0: nothing is lit beyond; default 100
    pub range: f64,
}

/// Casters of shadows, and receivers that they fall on: each a list of boxes or a set. Both may be the same.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_scene {
    /// set by gnomon_scene_default
    pub size: u32,
    /// 0
    pub reserved: u32,
    /// boxes, six doubles each; NULL with a count of 0 or with a set; default NULL
    pub casters: *const f64,
    /// boxes of the list, at least 0; default 0
    pub caster_count: i64,
    /// the same of what shadows fall on
    pub receivers: *const f64,
    /// the same
    pub receiver_count: i64,
    /// in place of the list, or NULL, the default
    pub caster_set: *const gnomon_caster_set,
    /// the same
    pub receiver_set: *const gnomon_caster_set,
}

/// Visible view depths of a frame: pixels in each bin of the logarithm of depth. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_visible_depths {
    /// eight bins per doubling, from 2^-20 world units on
    pub count: [u32; 352],
    /// nearest visible depth, world units; min > max: nothing is visible
    pub min: f64,
    /// farthest visible depth, world units
    pub max: f64,
}

/// A camera, and what is known of the surfaces that it sees.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_view {
    /// set by gnomon_view_default
    pub size: u32,
    /// 0
    pub reserved: u32,
    /// required; default NULL
    pub camera: *const gnomon_camera,
    /// of this frame or the last ones; NULL, the default: unknown
    pub depths: *const gnomon_visible_depths,
    /// Points of surfaces that the camera sees, world space, three doubles each: of a depth buffer, or first hits of rays. NULL, the default: unknown. Time grows with their number.
    pub points: *const f64,
    /// Unit normals at the points towards the eye, as many; NULL, the default: unknown. Pages read them, and warps do not serve points that are turned from the light.
    pub normals: *const f64,
    /// points, at least 0; default 0
    pub point_count: i64,
}

/// Options of a plan. Every default suits most scenes. The names are those of PlanOptions in gnomon/options.hpp, with an underscore for each dot.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_plan_options {
    /// set by gnomon_plan_options_default
    pub size: u32,
    /// Maps along the view, 1..GNOMON_MAX_MAPS; default 4. More lower the error far away and cost a pass each. Directional lights only: a spot light has one map, a point light or a wide spot light up to six.
    pub cascades: i32,
    /// texels along each side of each map, 4..16384; default 1024
    pub resolution_max_size: i32,
    /// World sizes per octave that maps of fit stable may have, 1..1024; default 1024. Fewer keep the grid unchanged through a zoom, and enlarge texels by up to 1 / steps.
    pub resolution_stable_size_steps: i32,
    /// Error m (screen pixels per texel) that suffices; 0, the default: none. Above 0, the plan takes the fewest cascades and the smallest maps that meet it.
    pub resolution_max_error: f64,
    /// Most texels of all maps together; 0, the default: no budget. By objective picture, divided so that the mean error over visible points is least; else, so that all maps have the same worst error.
    pub resolution_texel_budget: i64,
    /// error m that prune rule metric_resolution shrinks maps to, >= 1e-9; default 1
    pub resolution_prune_error: f64,
    /// GNOMON_FITS; default tight: the best texels. `stable` keeps texels at their place in the world under camera motion.
    pub fit: i32,
    /// GNOMON_SPLITS: how depths are divided among cascades; default auto
    pub split_scheme: i32,
    /// practical: from uniform (0) to logarithmic (1); default 0.7
    pub split_lambda: f64,
    /// view depth from which error counts, world units, >= 0; default 0
    pub split_pseudo_near: f64,
    /// GNOMON_RANGE_AUTOMATIC, the default, and others: which depths are divided
    pub split_range: i32,
    /// GNOMON_SELECTIONS: view_depth, the default, or finest; how a point finds its map
    pub split_selection: i32,
    /// scheme given: cascades - 1 ascending view depths between cascades, all finite; default infinity
    pub split_given: [f64; 7],
    /// blend band before a cascade, share of the depths before it, 0..1; default 0
    pub split_overlap: f64,
    /// GNOMON_PARTITIONS: how receivers are divided; default view_depth
    pub split_partition: i32,
    /// partition frustum_faces: most slices of a side face, 1..8; default 1
    pub split_face_slices: i32,
    /// GNOMON_WARPS; GNOMON_DEFAULT, the default: the plan measures, and takes what lowers the error most. A warp that does not lower it is dropped and listed.
    pub warp: i32,
    /// GNOMON_SHAPES: how texels lie; default linear. Others need more of a renderer
    pub warp_shape: i32,
    /// GNOMON_OBJECTIVES: the error that a warp must lower; default picture
    pub warp_objective: i32,
    /// 0
    pub reserved: i32,
    /// box whose error counts more; an empty one, the default: none
    pub warp_focus: [f64; 6],
    /// how many times, 1..1e6; default 4
    pub warp_focus_weight: f64,
    /// Planes that get a map each, as point (3), normal (3) and thickness (1). A thickness of 0, the default: no plane. Receivers within the thickness of a plane, world units, to either side, take its map.
    pub warp_planes: [[f64; 7]; 3],
    /// Frames from one plan of a cascade behind the first to its next, 1..64; default 1. More need a history.
    pub cadence_frames: i32,
    /// bits of GNOMON_PRUNE_RULES; default: the exact ones, light_depths and equal_cascades
    pub prune: u32,
    /// largest step of the eye from frame to frame, world units, >= 0; default 0
    pub cadence_largest_step: f64,
    /// largest turn of the camera from frame to frame, radians, 0..pi; default 0
    pub cadence_largest_turn: f64,
    /// kernel radius of the filter, texels, 0..a quarter of the map; default 1
    pub filter_texels: f64,
    /// the same in world units, >= 0; default 0. The wider of the two counts
    pub filter_world: f64,
    /// along the light, texels, >= 0; default 0.15
    pub bias_constant_texels: f64,
    /// along the light, texels times tan(normal, light), >= 0; default 0.5
    pub bias_slope_texels: f64,
    /// along the normal, texels times sin(normal, light), >= 0; default 0.1
    pub bias_normal_offset_texels: f64,
    /// cap of tan(normal, light) in the slope term, >= 0; default 4
    pub bias_max_slope: f64,
    /// Local lights: where maps begin, over the distance of the farthest receiver, 1e-7..0.5; default 2^-10.
    pub light_near_share: f64,
    /// of all matrices of the plan; default OpenGL
    pub clip_space: gnomon_clip_space,
}

/// Texels \[x, x + width) times \[y, y + height) of a map, as its memory is: columns from ndc x = -1. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_texel_rect {
    /// texels; empty where width or height is 0
    pub x: i32,
    /// texels; empty where width or height is 0
    pub y: i32,
    /// texels; empty where width or height is 0
    pub width: i32,
    /// texels; empty where width or height is 0
    pub height: i32,
}

/// One shadow map: what drawing, reading, culling and measuring it needs. For maps of one's own (foreign matrices), fill in defaults, then clip_from_world, width, height and the depths.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_map {
    /// set by gnomon_map_default, and by calls that write maps
    pub size: u32,
    /// index of the cascade, face or part that the map serves
    pub cascade: i32,
    /// clip space of the map from world space
    pub clip_from_world: [f64; 16],
    /// the same for points relative to gnomon_plan::origin
    pub clip_from_camera_relative: [f32; 16],
    /// view depth from which the map serves points, world units
    pub depth_begin: f64,
    /// view depth up to which it does, world units
    pub depth_end: f64,
    /// width of the blend band before depth_begin, world units
    pub overlap: f64,
    /// the light's position with w = 1, or unit direction towards it with w = 0
    pub light_world: [f64; 4],
    /// texels
    pub width: i32,
    /// texels
    pub height: i32,
    /// GNOMON_SHAPES
    pub shape: i32,
    /// GNOMON_WARPS: the one that was used; GNOMON_DEFAULT: not known
    pub warp: i32,
    /// of the shape
    pub shape_parameters: [f64; 15],
    /// strength of the warp, 1 / world units; local lights: 1 / slope; 0: none
    pub kappa: f64,
    /// extent of a texel across the light at the body's centre, world units
    pub texel_world: [f64; 2],
    /// the same where it is largest
    pub texel_world_max: [f64; 2],
    /// from near to far plane along the light, world units
    pub depth_range_world: f64,
    /// bias at the body's centre along the light, world units
    pub bias_constant: f64,
    /// the same per unit of tan(normal, light)
    pub bias_slope: f64,
    /// along the normal, world units, per unit of sin(normal, light)
    pub bias_normal_offset: f64,
    /// border that no receiver falls into, texels along each side
    pub filter_margin_texels: i32,
    /// entries of cull_planes that are used
    pub cull_plane_count: i32,
    /// Planes round all that can shadow a receiver of this map. A caster counts if part of it lies where dot(xyz, p) + w >= 0 for all of them. World space, unit normals. Unused ones are 0.
    pub cull_planes: [[f64; 4]; 32],
    /// entries of select_planes that are used
    pub select_plane_count: i32,
    /// flag: the grid is that of fit stable, and the snap fields hold
    pub snap_valid: i32,
    /// the map serves a point only inside all of them; as above
    pub select_planes: [[f64; 4]; 4],
    /// place of the grid, texels
    pub snap_x: i64,
    /// place of the grid, texels
    pub snap_y: i64,
    /// depth range of the grid, depth steps
    pub snap_depth_near: i64,
    /// depth range of the grid, depth steps
    pub snap_depth_far: i64,
    /// sides of a texel of the grid, world units
    pub snap_texel: [f64; 2],
    /// largest perspective error along the map's x and y, screen pixels per texel
    pub m_s_max: f64,
    /// largest perspective error along the map's x and y, screen pixels per texel
    pub m_t_max: f64,
    /// bound of the perspective error in any direction, screen pixels per texel
    pub m_max: f64,
    /// texels per screen pixel for an error of 1 everywhere in this map
    pub storage: f64,
}

/// Something that this scene did not need, or an option that did not hold. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_omission {
    /// GNOMON_CASCADE_WITHOUT_RECEIVER and others: decides what a and b hold
    pub kind: i32,
    /// the cascade or face that it is about, as gnomon_map::cascade; -1: the whole plan
    pub map: i32,
    /// as the kind states
    pub a: f64,
    /// as the kind states
    pub b: f64,
    /// texels that are not drawn
    pub saves_texels: i64,
}

/// Two lines of English. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_text {
    /// zero-terminated
    pub what: [c_char; 48],
    /// zero-terminated
    pub why: [c_char; 144],
}

/// A plan. Its maps lie in the caller's array. Set the fields marked "in" before the call; the others are results.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_plan {
    /// set by gnomon_plan_default
    pub size: u32,
    /// in: sizeof(gnomon_map)
    pub map_size: u32,
    /// in: where maps are written
    pub maps: *mut gnomon_map,
    /// in: where omissions are written, or NULL, the default
    pub omissions: *mut gnomon_omission,
    /// in: entries of maps; GNOMON_MAX_MAPS always suffice
    pub map_room: i32,
    /// in: entries of omissions; GNOMON_MAX_OMISSIONS always suffice
    pub omission_room: i32,
    /// as the call returned
    pub status: i32,
    /// maps to draw; 0 unless status is GNOMON_OK
    pub map_count: i32,
    /// omissions; may exceed omission_room
    pub omission_count: i32,
    /// GNOMON_SELECTIONS: how a point finds its map
    pub selection: i32,
    /// flag: sizes of maps may change from frame to frame
    pub sizes_vary: i32,
    /// 0
    pub reserved: i32,
    /// what clip_from_camera_relative is relative to, world space: the camera
    pub origin: [f64; 3],
    /// unit, the way the light travels; of a point light towards the camera
    pub light_direction: [f64; 3],
    /// of all matrices of the plan
    pub clip_space: gnomon_clip_space,
    /// of the options
    pub bias_constant_texels: f64,
    /// of the options
    pub bias_slope_texels: f64,
    /// of the options
    pub bias_normal_offset_texels: f64,
    /// of the options
    pub bias_max_slope: f64,
}

/// A discontinuity of one map from the last frame to this one. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_event {
    /// GNOMON_MAP_APPEARED and others
    pub kind: i32,
    /// gnomon_map::cascade
    pub map: i32,
    /// texels per area of now over before, where it is farthest from 1
    pub density_ratio: f64,
}

/// How to make a map from that of the last frame. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_reuse {
    /// GNOMON_REUSE_NONE and others
    pub kind: i32,
    /// texel (x, y) of the old map is (x + shift_x, y + shift_y) of the new one
    pub shift_x: i32,
    /// texel (x, y) of the old map is (x + shift_x, y + shift_y) of the new one
    pub shift_y: i32,
    /// strips to draw, 0..2
    pub strip_count: i32,
    /// part of the new map whose texels hold
    pub kept: gnomon_texel_rect,
    /// parts to draw
    pub strip: [gnomon_texel_rect; 2],
}

/// A bias in an engine's units. All of it is towards the light. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_engine_bias {
    /// of the map's depth, 0..1
    pub depth: f64,
    /// times the larger growth of depth over a texel, along the map's x or y
    pub slope_factor: f64,
    /// along the normal, world units
    pub normal_world: f64,
    /// `depth` in units of rasterizer states: steps of the map's format
    pub units: f64,
}

/// The decision of gnomon_hold_sun. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_held_sun {
    /// to plan with: the held one, or the sun's own, bit for bit
    pub direction: [f64; 3],
    /// largest error of the points that were read, screen pixels
    pub error_pixels: f64,
    /// error of the point that turned it, above the bound; 0: none did
    pub turned_pixels: f64,
    /// points that the light grazes more than least_light_sine: not evaluated
    pub points_capped: i64,
}

/// Where maps lie in one texture; no two share a texel. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_atlas {
    /// texels; 0: there is no map, or the maps do not fit
    pub width: i32,
    /// texels; 0: there is no map, or the maps do not fit
    pub height: i32,
    /// by index of the map in the plan
    pub place: [gnomon_texel_rect; 8],
    /// maps placed: all of the plan's, or none
    pub count: i32,
    /// 0
    pub reserved: i32,
    /// texels of the maps over those of the texture, in 0..1
    pub efficiency: f64,
}

/// How an error is sampled.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_measure_options {
    /// set by gnomon_measure_options_default
    pub size: u32,
    /// index of the one map whose points count; -1, the default: all
    pub map: i32,
    /// pixels across, 1..65536; default 64. Not read where the view has points, as the next two
    pub columns: i32,
    /// pixels down, 1..65536; default 64
    pub rows: i32,
    /// depths along each pixel's ray, 1..65536; default 64
    pub depths: i32,
    /// 0
    pub reserved: i32,
}

/// The aliasing error m, screen pixels per texel, over many points. Above 1, texels show.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_stats {
    /// set by gnomon_stats_default
    pub size: u32,
    /// 0
    pub reserved: u32,
    /// half of the points stay below
    pub p50: f64,
    /// 95 % of the points stay below
    pub p95: f64,
    /// largest
    pub max: f64,
    /// mean: orders techniques by their misclassified pixels best
    pub mean: f64,
    /// share of the points above 1, in 0..1
    pub share_undersampled: f64,
    /// texels per screen pixel for an error of 1 everywhere
    pub storage: f64,
    /// points that counted
    pub samples: i64,
    /// points of visible receivers that no map holds
    pub outside: i64,
}

/// The aliasing error at one point, screen pixels per texel. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_point_error {
    /// GNOMON_POINT_OK and others: whether the fields hold
    pub status: i32,
    /// 0
    pub reserved: i32,
    /// longest and shortest extent of a texel
    pub m_max: f64,
    /// longest and shortest extent of a texel
    pub m_min: f64,
    /// extent along the map's x and y
    pub m_s: f64,
    /// extent along the map's x and y
    pub m_t: f64,
    /// square root of a texel's area in pixels
    pub m_area: f64,
    /// m_max over m_min
    pub anisotropy: f64,
    /// the same on a surface that faces the half vector
    pub perspective_max: f64,
    /// the same on a surface that faces the half vector
    pub perspective_s: f64,
    /// the same on a surface that faces the half vector
    pub perspective_t: f64,
    /// cos(normal, eye) over cos(normal, light)
    pub projection: f64,
}

/// A shadow as a camera sees it: of other maps, of the last frame, or of rays.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_shadow_picture {
    /// set by gnomon_shadow_picture_default
    pub size: u32,
    /// 0
    pub reserved: u32,
    /// its width and height are those of both pictures; required; default NULL
    pub camera: *const gnomon_camera,
    /// A number for each pixel, rows from top to bottom: 1 lit .. 0 in shadow. Not counted: negative numbers, numbers above 1, not a number. Columns go along cross(forward, up): those of a left-handed world from right to left. Required; default NULL.
    pub mask: *const f32,
    /// View depths of the surfaces, as many, world units. No surface: 0, less, infinity, not a number. Required; default NULL.
    pub view_depths: *const f32,
    /// entries of each: the camera's width times height
    pub pixel_count: i64,
    /// Half side of the box of texels whose comparisons the filter averages. 0, the default, less, and not a number: one texel, hard comparison. More than 33 count as 33.
    pub kernel_texels: f64,
    /// For each dark pixel the distance along the light from the surface to the occluder nearest the light, world units. A bias that is longer lights the surface. Negative, not a number: not known there. NULL, the default: not known, and errors of the bias do not count. Not read beside occluder_search.
    pub occluder_distances: *const f32,
    /// Searches what casts shadows in the picture's light. With it errors are those of the maps' own comparisons, also where the picture does not show the middle of a texel. NULL, the default: none.
    pub occluder_search: gnomon_occluder_search,
    /// handed to it; default NULL
    pub occluder_scene: *const core::ffi::c_void,
    /// Beside occluder_search: normals of the surfaces, unit, towards the viewer, three numbers for each pixel. Zero there, and NULL, the default: from view_depths.
    pub normals: *const f32,
}

/// The pixels that a plan will get wrong. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_wrong_pixels {
    /// lit and dark pixels that are taken for each other; no whole number
    pub wrong: f64,
    /// pixels that have a surface, and are lit or dark
    pub counted: f64,
    /// wrong over counted, in 0..1; 0 where none counts
    pub share: f64,
}

/// Options of gnomon_plan_pages. Every default suits most scenes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_page_options {
    /// set by gnomon_page_options_default
    pub size: u32,
    /// GNOMON_PAGE_POLICIES: how fine the page of a point is; default resolution
    pub policy: i32,
    /// The base of the levels; NULL, the default: the defaults with warp none, as levels follow the view already. With fit stable, pages keep their place in the world under camera motion.
    pub plan: *const gnomon_plan_options,
    /// texels along each side that a page serves: 64, 128, the default, or 256
    pub page_texels: i32,
    /// pages of the pool, 1..2^20; default 4096. Too few: all levels coarsen evenly
    pub capacity: i32,
    /// error along either side of a texel that no visible point exceeds; default 1
    pub target_m: f64,
    /// share of the visible points that must meet it, in (0, 1\]; default 1
    pub share: f64,
    /// steps in which texels halve, 1..4; default 3
    pub levels_per_octave: i32,
    /// positions of the levels' sizes that are tried, 1..16; default 1
    pub trials: i32,
    /// largest side of a level, texels, page_texels..2^26; default 2^22
    pub virtual_texels: i32,
    /// flag: the coarsest level is resident everywhere; default 0
    pub fallback: i32,
    /// room round each point, texels of its level, 0..page_texels; default 0
    pub reach_texels: f64,
    /// sine of the angle to the light below which normals do not count; default 0.05
    pub least_light_sine: f64,
}

/// One resident page. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_page {
    /// index of its level
    pub level: u32,
    /// of the level's virtual map, from ndc (-1, -1)
    pub column: i32,
    /// of the level's virtual map, from ndc (-1, -1)
    pub row: i32,
    /// place in the pool, below the capacity
    pub slot: u32,
    /// visible points that it was opened for
    pub points: u32,
}

/// A page plan: levels, and resident pages. It refers to the memory of the call, which must live as long.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_page_plan {
    /// set by gnomon_page_plan_default
    pub size: u32,
    /// as the call returned
    pub status: i32,
    /// in: where omissions are written, or NULL, the default
    pub omissions: *mut gnomon_omission,
    /// in: entries of omissions
    pub omission_room: i32,
    /// omissions; may exceed omission_room
    pub omission_count: i32,
    /// resident pages, coarsest level first; in the memory of the call
    pub pages: *const gnomon_page,
    /// hash table over the pages, as shaders/library reads it; in the same memory
    pub table: *const u32,
    /// the memory of the call; other calls read it
    pub memory: *const core::ffi::c_void,
    /// resident pages
    pub page_count: i64,
    /// entries of table
    pub table_count: i64,
    /// levels that have pages, coarsest first: gnomon_page_level
    pub level_count: i32,
    /// GNOMON_PAGE_POLICIES
    pub policy: i32,
    /// texels that a page serves along each side
    pub page_texels: i32,
    /// texels round them in the page's slot, which hold the filter's kernel
    pub border_texels: i32,
    /// slots of the pool
    pub capacity: i32,
    /// 0
    pub reserved: i32,
    /// what clip_from_camera_relative is relative to, world space
    pub origin: [f64; 3],
    /// unit, the way the light travels
    pub light_direction: [f64; 3],
    /// of all matrices of the plan
    pub clip_space: gnomon_clip_space,
    /// error that levels were chosen for; larger than requested where the pool is small
    pub target_m: f64,
    /// visible points that pages serve
    pub points: i64,
    /// beside all receivers or beyond the light's range: lit
    pub points_outside: i64,
    /// left to a coarser level by gnomon_page_options::share
    pub points_coarser: i64,
    /// that the deepest level does not suffice for
    pub points_capped: i64,
}

/// Report of the last frame's image, for policies that read it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_page_history {
    /// set by gnomon_page_history_default
    pub size: u32,
    /// 0
    pub reserved: u32,
    /// the plan of the last frame, in other memory than the new one; NULL, the default: none
    pub last: *const gnomon_page_plan,
    /// bits of each of gnomon_view::points; NULL, the default: nothing was reported
    pub feedback: *const u8,
    /// entries of feedback
    pub feedback_count: i64,
}

/// One slot of a pool that keeps pages from frame to frame: set it to zeros, and then leave it to gnomon_keep_pages. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_page_slot {
    /// of the page that was drawn into it
    pub clip_from_world: [f64; 16],
    /// along each side
    pub texels: i32,
    /// 0
    pub reserved: i32,
    /// count of the last call that used it; 0: it holds nothing
    pub used: u64,
    /// not 0: a moving caster touched it since those were last drawn
    pub behind: u64,
}

/// Where a page of a plan lies in a pool. Its size is fixed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_kept_page {
    /// of the pool, in place of gnomon_page::slot
    pub slot: u32,
    /// flag: the page is to be drawn
    pub draw: u8,
    /// flag: only its moving casters are, over the static ones
    pub compose: u8,
    /// 0
    pub reserved: [u8; 2],
}

/// One light of gnomon_plan_lights.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light_request {
    /// set by gnomon_light_request_default
    pub size: u32,
    /// flag: its casters moved, or its maps are lost; default 0
    pub changed: i32,
    /// required; default NULL
    pub light: *const gnomon_light,
    /// counts its error so many times, >= 0; default 1
    pub weight: f64,
    /// draw calls of all its maps, >= 0; default 0. Read with millisecond_budget
    pub draws: f64,
    /// triangles of all its maps, >= 0; default 0. The same
    pub triangles: f64,
}

/// Options of gnomon_plan_lights. Every default suits most scenes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light_options {
    /// set by gnomon_light_options_default
    pub size: u32,
    /// most pages of all maps together, >= 0; 0, the default: no such budget
    pub page_budget: i32,
    /// of the plans of all lights; NULL, the default: the defaults
    pub plan: *const gnomon_plan_options,
    /// texels of the pool, multiples of most_size, up to 2^16; default 4096
    pub pool_width: i32,
    /// texels of the pool, multiples of most_size, up to 2^16; default 4096
    pub pool_height: i32,
    /// most texels of all maps together, at least 1; default: the pool's
    pub texel_budget: i64,
    /// side of a page, a power of two up to most_size; default 128
    pub page_texels: i32,
    /// side of the smallest maps, texels, a power of two; default 64
    pub least_size: i32,
    /// side of the largest maps, texels, a power of two up to 16384; default 1024
    pub most_size: i32,
    /// most frames from one drawing of a light to the next, 1..64; default 8
    pub most_frames: i32,
    /// most milliseconds per frame by the costs, >= 0; 0, the default: none
    pub millisecond_budget: f64,
    /// milliseconds, >= 0; default 0
    pub cost_per_map: f64,
    /// milliseconds, >= 0; default 0
    pub cost_per_megatexel: f64,
    /// milliseconds, >= 0; default 0
    pub cost_per_kilodraw: f64,
    /// milliseconds, >= 0; default 0
    pub cost_per_megatriangle: f64,
    /// error that suffices, screen pixels per texel, >= 0; 0, the default: none
    pub enough_m: f64,
    /// share of the picture refreshed every frame, in (0, 1\]; default 1/64
    pub full_share: f64,
    /// with a history: how much a light's last size is favoured, >= 1; default 1.5
    pub keep_gain: f64,
}

/// The maps of one light in the pool.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light_maps {
    /// written by the call: gnomon_light_plan::light_size
    pub size: u32,
    /// GNOMON_LIGHT_MAPPED and others
    pub outcome: i32,
    /// along each side of each map; 0: none
    pub texels: i32,
    /// maps that have a place
    pub map_count: i32,
    /// in the pool, by index of the map in the light's plan
    pub place: [gnomon_texel_rect; 8],
    /// part of the picture that the light may light, in 0..1
    pub share: f64,
    /// mean error over that part, screen pixels per texel
    pub m: f64,
    /// from one drawing to the next
    pub frames: i32,
    /// flag: plan and draw its maps in this frame
    pub due: i32,
}

/// A plan of many lights. Set the fields marked "in" before the call; the others are results.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light_plan {
    /// set by gnomon_light_plan_default
    pub size: u32,
    /// in: sizeof(gnomon_light_maps)
    pub light_size: u32,
    /// in: where the maps of each light are written, in the order of the requests
    pub lights: *mut gnomon_light_maps,
    /// in: entries of lights, at least as many as requests
    pub light_room: i64,
    /// lights; 0 where the call was refused
    pub light_count: i64,
    /// as the call returned
    pub status: i32,
    /// index of the light that was refused; -1: of none
    pub invalid_light: i32,
    /// texels
    pub pool_width: i32,
    /// texels
    pub pool_height: i32,
    /// of all maps
    pub texels: i64,
    /// of the maps that are due
    pub due_texels: i64,
    /// of all maps; 0 without a page budget
    pub pages: i64,
    /// by the costs, per frame in the mean
    pub milliseconds: f64,
    /// the same, of what is due in this frame
    pub due_milliseconds: f64,
    /// sum of weight times share times m, which the sizes minimise
    pub error: f64,
    /// lights that have maps
    pub mapped: i32,
    /// of them, to be planned and drawn in this frame
    pub due: i32,
    /// flag: all maps were placed again
    pub repacked: i32,
    /// 0
    pub reserved: i32,
}

/// Lists of the lights that reach into each cluster of the view: a tile of pixels times a slice of depth. Set the fields marked "in" before the call; the others are results.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gnomon_light_clusters {
    /// set by gnomon_light_clusters_default
    pub size: u32,
    /// in: side of a tile, pixels, at least 1; default 64. Also a result: larger where the lists hold no finer ones
    pub tile_pixels: i32,
    /// in: parts of the view depth, 1..256; default 48
    pub depth_slices: i32,
    /// as the call returned
    pub status: i32,
    /// in: where each cluster's list begins; required
    pub begin: *mut u32,
    /// in: the lists, indices of lights in ascending order; required
    pub lights: *mut u32,
    /// in: entries of begin: gnomon_cluster_count + 1 suffice, 2 are required
    pub begin_room: i64,
    /// in: entries of lights, at least as many as lights. More: finer clusters
    pub light_room: i64,
    /// clusters along the image's sides and along depth
    pub columns: i32,
    /// clusters along the image's sides and along depth
    pub rows: i32,
    /// clusters along the image's sides and along depth
    pub slices: i32,
    /// flag of the camera
    pub orthographic: i32,
    /// Slice of a surface: floor(depth_scale * log2(view depth) + depth_offset), of the view depth itself for an orthographic camera, clamped to 0..slices - 1.
    pub depth_scale: f64,
    /// see depth_scale
    pub depth_offset: f64,
    /// entries of lights that are used
    pub light_count: i64,
}

extern "C" {
    /// Entries of a list, GNOMON_WARPS to GNOMON_STATUSES. 0 for any other list.
    pub fn gnomon_count(list: i32) -> i32;
    /// Name of an entry, zero-terminated and static. NULL where there is no such list or index.
    pub fn gnomon_name(list: i32, index: i32) -> *const c_char;
    /// One line about an entry, static. "" for lists whose names say it all, NULL where there is no such entry.
    pub fn gnomon_summary(list: i32, index: i32) -> *const c_char;
    /// Index of a name, or GNOMON_UNKNOWN where the list has none such; NULL is no name. Names stay, indices may change between versions: find them at start.
    pub fn gnomon_find(list: i32, name: *const c_char) -> i32;
    /// Version of the library as "major.minor.patch", static.
    pub fn gnomon_version() -> *const c_char;
    /// Fills in defaults. `size`: sizeof *camera. Refuses NULL and sizes that no version had: "camera.size".
    pub fn gnomon_camera_default(camera: *mut gnomon_camera, size: u32) -> i32;
    /// Sets a symmetric perspective; all other fields are unchanged. `fov_y`: full vertical angle, radians, in (0, pi). `aspect`: width over height, above 0. `width`, `height`: pixels.
    pub fn gnomon_perspective(camera: *mut gnomon_camera, fov_y: f64, aspect: f64, near_depth: f64, far_depth: f64, width: i32, height: i32, invalid_field: *mut *const c_char) -> i32;
    /// Sets a parallel projection of `height_world` world units from bottom to top; all other fields are unchanged.
    pub fn gnomon_orthographic(camera: *mut gnomon_camera, height_world: f64, aspect: f64, near_depth: f64, far_depth: f64, width: i32, height: i32, invalid_field: *mut *const c_char) -> i32;
    /// Makes the camera of an engine's own matrices: perspective or parallel, centred or off-axis, far plane finite or not. `clip_space` is that of `clip_from_view`; NULL: OpenGL. Matrices may be rounded to float. Views may scale evenly. Refuses what is no camera. `*why`, unless NULL, is then one static sentence without a full stop, else NULL. `camera` comes from gnomon_camera_default.
    pub fn gnomon_camera_from(view_from_world: *const f64, clip_from_view: *const f64, clip_space: *const gnomon_clip_space, width: i32, height: i32, camera: *mut gnomon_camera, why: *mut *const c_char, invalid_field: *mut *const c_char) -> i32;
    /// Writes the matrix from a map's clip space to its texture. x and y are 0..1 from the first texel of the first row on, z is the depth in 0..1. `clip_space`: of the map; NULL: OpenGL.
    pub fn gnomon_texture_from_clip(clip_space: *const gnomon_clip_space, texture_from_clip: *mut f64) -> i32;
    /// Fills in defaults. `size`: sizeof *light. Refuses NULL and sizes that no version had.
    pub fn gnomon_light_default(light: *mut gnomon_light, size: u32) -> i32;
    /// Sorts `count` boxes into a new set, which owns a copy of them: about 64 bytes a box. Takes O(count log count). `*set` is NULL where the call fails. Empty boxes keep their place, and are never listed.
    pub fn gnomon_caster_set_create(boxes: *const f64, count: i64, set: *mut *mut gnomon_caster_set, invalid_field: *mut *const c_char) -> i32;
    /// Frees the set; NULL does nothing.
    pub fn gnomon_caster_set_destroy(set: *mut gnomon_caster_set);
    /// Boxes in the set, empty ones included; 0 for NULL.
    pub fn gnomon_caster_set_count(set: *const gnomon_caster_set) -> i64;
    /// Takes new bounds for all boxes, in their first order. Right for any motion, fast while neighbours stay neighbours. `count` is gnomon_caster_set_count.
    pub fn gnomon_caster_set_refit(set: *mut gnomon_caster_set, boxes: *const f64, count: i64, invalid_field: *mut *const c_char) -> i32;
    /// Takes new bounds for the box `index`. Takes O(log count).
    pub fn gnomon_caster_set_update(set: *mut gnomon_caster_set, index: i64, r#box: *const f64, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults: a scene without boxes. `size`: sizeof *scene.
    pub fn gnomon_scene_default(scene: *mut gnomon_scene, size: u32) -> i32;
    /// Sets it to no visible depth. NULL does nothing.
    pub fn gnomon_visible_depths_clear(depths: *mut gnomon_visible_depths);
    /// Counts the view depths of pixels. Not counted, as the sky: 0, less, infinity, not a number.
    pub fn gnomon_visible_depths_add(depths: *mut gnomon_visible_depths, view_depths: *const f32, count: i64, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *view.
    pub fn gnomon_view_default(view: *mut gnomon_view, size: u32) -> i32;
    /// A new, empty tracker, or NULL where there is no memory or a number is out of 1..65535. `frames_per_bin`: frames that the nearest and the farthest depth take to move inwards by one bin; 4 suits most scenes. `hold_frames`: frames for which a depth between them that shows nothing any more still counts; 30 does.
    pub fn gnomon_depth_tracker_create(frames_per_bin: i32, hold_frames: i32) -> *mut gnomon_depth_tracker;
    /// Frees the tracker; NULL does nothing.
    pub fn gnomon_depth_tracker_destroy(tracker: *mut gnomon_depth_tracker);
    /// Forgets all frames: call it at a cut. NULL does nothing.
    pub fn gnomon_depth_tracker_clear(tracker: *mut gnomon_depth_tracker);
    /// Takes the visible depths of the next frame, and writes those to plan with to `depths`, which may be `frame`. A frame that shows nothing changes nothing. Before the first surface `depths` shows nothing either.
    pub fn gnomon_depth_tracker_update(tracker: *mut gnomon_depth_tracker, frame: *const gnomon_visible_depths, depths: *mut gnomon_visible_depths, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *options.
    pub fn gnomon_plan_options_default(options: *mut gnomon_plan_options, size: u32) -> i32;
    /// Fills in defaults: an empty map of linear texels, GNOMON_DEFAULT as warp. `size`: sizeof *map.
    pub fn gnomon_map_default(map: *mut gnomon_map, size: u32) -> i32;
    /// Puts an omission into words. NULL for either does nothing; a kind that is none gives empty lines.
    pub fn gnomon_describe(omission: *const gnomon_omission, text: *mut gnomon_text);
    /// Fills in defaults: no room, no map. `size`: sizeof *plan.
    pub fn gnomon_plan_default(plan: *mut gnomon_plan, size: u32) -> i32;
    /// A new, empty history, or NULL where there is no memory. About 20 kB.
    pub fn gnomon_history_create() -> *mut gnomon_history;
    /// Frees the history; NULL does nothing.
    pub fn gnomon_history_destroy(history: *mut gnomon_history);
    /// Forgets all frames: call it at a cut. NULL does nothing.
    pub fn gnomon_history_clear(history: *mut gnomon_history);
    /// Makes `to` equal to `from`, to try a frame twice. NULL for either does nothing.
    pub fn gnomon_history_copy(from: *const gnomon_history, to: *mut gnomon_history);
    /// Writes the events of the last plan, at most `room`. Returns how many there are; 0 for NULL.
    pub fn gnomon_history_events(history: *const gnomon_history, events: *mut gnomon_event, room: i32) -> i32;
    /// Chooses the shadow maps of one light for one view. `options`: NULL for defaults. `history`: NULL for a plan of its own. Returns GNOMON_OK, GNOMON_NOTHING_VISIBLE, GNOMON_NO_CASTER or GNOMON_INVALID_INPUT, and sets `plan->status` to the same. Refused input leaves no map. Allocates nothing.
    pub fn gnomon_make_plan(view: *const gnomon_view, light: *const gnomon_light, scene: *const gnomon_scene, options: *const gnomon_plan_options, history: *mut gnomon_history, plan: *mut gnomon_plan, invalid_field: *mut *const c_char) -> i32;
    /// Chooses the maps that several cameras share: two eyes, a split screen, faces of a probe. `cameras`: `count` pointers, 1..GNOMON_MAX_VIEWS. gnomon_plan::origin is the mean of the eyes. Otherwise as gnomon_make_plan.
    pub fn gnomon_plan_views(cameras: *const *const gnomon_camera, count: i32, light: *const gnomon_light, scene: *const gnomon_scene, options: *const gnomon_plan_options, plan: *mut gnomon_plan, invalid_field: *mut *const c_char) -> i32;
    /// Finds the map of each point: `indices\[i\]` is its index in the plan's maps, or -1 where the point is lit. `points`: world space, three doubles each. `view_depths`: of the points, world units.
    pub fn gnomon_select(plan: *const gnomon_plan, points: *const f64, view_depths: *const f64, count: i64, indices: *mut i32, invalid_field: *mut *const c_char) -> i32;
    /// Writes the indices of the boxes that a map needs to `indices`, at most `room`, and how many there are to `*found`. No caster that can shadow a receiver of the map is missing.
    pub fn gnomon_cull(map: *const gnomon_map, casters: *const f64, count: i64, indices: *mut u32, room: i64, found: *mut i64, invalid_field: *mut *const c_char) -> i32;
    /// The same of a set, in no particular order. Time grows with what lies across the planes.
    pub fn gnomon_cull_set(map: *const gnomon_map, set: *const gnomon_caster_set, indices: *mut u32, room: i64, found: *mut i64, invalid_field: *mut *const c_char) -> i32;
    /// The same for planes of one's own, four doubles each, 0..GNOMON_MAX_CULL_PLANES: gnomon_rectangle_planes, say.
    pub fn gnomon_cull_planes(planes: *const f64, plane_count: i32, set: *const gnomon_caster_set, indices: *mut u32, room: i64, found: *mut i64, invalid_field: *mut *const c_char) -> i32;
    /// Makes `to` equal to `map` with clip_from_camera_relative for an eye at `origin`, world space: for a map that was kept from an earlier frame. `to` comes from gnomon_map_default, and may be `map` itself.
    pub fn gnomon_rebased(map: *const gnomon_map, origin: *const f64, to: *mut gnomon_map, invalid_field: *mut *const c_char) -> i32;
    /// Compares two maps of plans with this clip space; NULL: OpenGL. Casters must not have moved, and both frames must have drawn all casters over the map (gnomon_rectangle_planes) with depth clamp.
    pub fn gnomon_compare(previous: *const gnomon_map, current: *const gnomon_map, clip_space: *const gnomon_clip_space, reuse: *mut gnomon_reuse, invalid_field: *mut *const c_char) -> i32;
    /// Five planes round all that can throw a shadow into a rectangle of a map, for gnomon_cull_planes. Open towards the light.
    pub fn gnomon_rectangle_planes(map: *const gnomon_map, rectangle: *const gnomon_texel_rect, clip_space: *const gnomon_clip_space, planes: *mut f64, invalid_field: *mut *const c_char) -> i32;
    /// Fills the uniform block of shaders/library/shadow_block.glsl, for std140 and std430: GNOMON_SHADER_BLOCK_FLOATS floats. `layer_width`, `layer_height`: texels of a layer of the texture; 0: those of the largest map. `blur_texels`: half side of the box that stored texels were blurred with, 0: none.
    pub fn gnomon_shader_block(plan: *const gnomon_plan, layer_width: i32, layer_height: i32, blur_texels: f64, block: *mut f32, invalid_field: *mut *const c_char) -> i32;
    /// Translates the bias of a map into an engine's own: what keeps planes from shadowing themselves under a kernel of this radius, texels. `map`: index in the plan. `way`: GNOMON_BIAS_RASTERIZER or GNOMON_BIAS_NORMAL_OFFSET. `depth_bits`: of a normalized integer, 1..32; 0: single precision. `depth` is right where the map's w is constant: parallel light without a warp. Elsewhere it holds in the middle of the map. A map without a depth range, as foreign ones are: all 0.
    pub fn gnomon_translate_bias(plan: *const gnomon_plan, map: i32, way: i32, kernel_radius_texels: f64, depth_bits: i32, bias: *mut gnomon_engine_bias, invalid_field: *mut *const c_char) -> i32;
    /// Offset of the texel grid in a frame, x and y in (-0.5, 0.5) texels. Offsets are a lattice of 64 points. Any GNOMON_JITTER_FRAMES frames in a row hold all of it. Refuses NULL.
    pub fn gnomon_jitter_texels(frame: u32, offset: *mut f64) -> i32;
    /// Moves the texel grid of every map of a plan by `offset` texels across the light, each clamped to half a texel. The maps serve the same points and casters. Add 0.5 to gnomon_plan_options::filter_texels before planning, so that no kernel leaves its map. The next frame cannot reuse moved maps.
    pub fn gnomon_jitter(plan: *mut gnomon_plan, offset: *const f64, invalid_field: *mut *const c_char) -> i32;
    /// Keeps the direction of a sun that turns until a shadow edge could lie more than `most_pixels` from its true place. Then takes the sun's own. Pages of fit stable keep their texels under a held direction. `view`: with points; without, the sun is not held. `held`: the direction of the last frame. `casters`: one box round all casters. `most_pixels`: >= 0; 0 never holds, 0.25 is below what a texel of m = 1 can show. `least_light_sine`: as gnomon_page_options::least_light_sine, 0..1; 0.05 suits most scenes.
    pub fn gnomon_hold_sun(view: *const gnomon_view, held: *const f64, sun: *const f64, casters: *const f64, most_pixels: f64, least_light_sine: f64, result: *mut gnomon_held_sun, invalid_field: *mut *const c_char) -> i32;
    /// Places the maps of a plan into a texture of `width` times `height` texels. Both 0: into the smallest one whose sides are powers of two, which any plan fits into. gnomon_atlas::count is 0 where they do not fit. The same sizes give the same places.
    pub fn gnomon_pack_atlas(plan: *const gnomon_plan, width: i32, height: i32, atlas: *mut gnomon_atlas, invalid_field: *mut *const c_char) -> i32;
    /// Writes the matrix from the clip space of a map to its part of the atlas: gnomon_texture_from_clip with the place of `map` taken in. Draw the map with its place as the viewport.
    pub fn gnomon_atlas_from_clip(atlas: *const gnomon_atlas, clip_space: *const gnomon_clip_space, map: i32, atlas_from_clip: *mut f64, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *options.
    pub fn gnomon_measure_options_default(options: *mut gnomon_measure_options, size: u32) -> i32;
    /// Fills in zeros. `size`: sizeof *stats.
    pub fn gnomon_stats_default(stats: *mut gnomon_stats, size: u32) -> i32;
    /// Measures the perspective error of a plan over what the view sees. It samples the view's points, else a grid of pixels and depths in the receivers' boxes. Matrices of another planner serve as well: in a plan of one's own, set status to GNOMON_OK, maps, map_size, map_room, map_count, clip_space and selection. `options`: NULL for defaults. Plans without maps give zeros.
    pub fn gnomon_measure(plan: *const gnomon_plan, view: *const gnomon_view, scene: *const gnomon_scene, options: *const gnomon_measure_options, stats: *mut gnomon_stats, invalid_field: *mut *const c_char) -> i32;
    /// Measures at each of `count` points, world space. `normals`: unit, as many; NULL: the perspective part alone. The map may be a foreign one.
    pub fn gnomon_measure_points(map: *const gnomon_map, camera: *const gnomon_camera, points: *const f64, normals: *const f64, count: i64, errors: *mut gnomon_point_error, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *picture.
    pub fn gnomon_shadow_picture_default(picture: *mut gnomon_shadow_picture, size: u32) -> i32;
    /// Counts the pixels that comparisons in the plan's maps will misclassify, without drawing them. A plan without maps gets all that is dark wrong. Foreign matrices serve as in gnomon_measure: where light_world is not the light of a matrix, the matrix's own counts. Time grows with the pixels. With occluder_search each pixel is compared with what lies on the light's ray through the middle of its texel, on the plane of its surface. Neighbours that read one texel search it once. Without, each pixel takes the shadow that the picture shows at the middle of its texel, where the texel meets the surface. Light that the plan's bias lets in counts where occluder_distances are known. Shadows narrower than a pixel count less than they should: the picture should be as fine as the texels.
    pub fn gnomon_expected_error(plan: *const gnomon_plan, picture: *const gnomon_shadow_picture, pixels: *mut gnomon_wrong_pixels, invalid_field: *mut *const c_char) -> i32;
    /// Writes points of the surfaces along the shadow's edges, world space, three doubles each. At most `room` of them, evenly over the picture; `*written` is how many. A plan for them (gnomon_view::points) has its texels where they show. Give such a plan visible points as well: maps reach no farther than its points.
    pub fn gnomon_shadow_edge_points(picture: *const gnomon_shadow_picture, points: *mut f64, room: i64, written: *mut i64, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *options.
    pub fn gnomon_page_options_default(options: *mut gnomon_page_options, size: u32) -> i32;
    /// Fills in defaults: no page. `size`: sizeof *plan.
    pub fn gnomon_page_plan_default(plan: *mut gnomon_page_plan, size: u32) -> i32;
    /// Fills in defaults. `size`: sizeof *history.
    pub fn gnomon_page_history_default(history: *mut gnomon_page_history, size: u32) -> i32;
    /// Bytes of memory that gnomon_plan_pages needs for a pool of this capacity and so many visible points; 0 where either is out of range. Without points, some ten thousand suffice for samples of the receivers' boxes.
    pub fn gnomon_page_memory(capacity: i32, points: i64) -> i64;
    /// Chooses the pages that the view's points need. `memory`: `bytes` bytes, at least gnomon_page_memory, aligned to 16. They hold the plan's lists until the next call that gets them. `options`, `history`: NULL for none.
    pub fn gnomon_plan_pages(view: *const gnomon_view, light: *const gnomon_light, scene: *const gnomon_scene, options: *const gnomon_page_options, history: *const gnomon_page_history, memory: *mut core::ffi::c_void, bytes: i64, plan: *mut gnomon_page_plan, invalid_field: *mut *const c_char) -> i32;
    /// Copies a level below level_count: width and height are those of the whole virtual map. `map`: gnomon_map_default.
    pub fn gnomon_page_level(plan: *const gnomon_page_plan, level: i32, map: *mut gnomon_map, invalid_field: *mut *const c_char) -> i32;
    /// The page of this index as a map of its own, to draw it and to cull its casters.
    pub fn gnomon_page_map(plan: *const gnomon_page_plan, page: i64, map: *mut gnomon_map, invalid_field: *mut *const c_char) -> i32;
    /// Finds the page that serves each of `count` points, world space: its index, or -1.
    pub fn gnomon_page_select(plan: *const gnomon_page_plan, points: *const f64, count: i64, indices: *mut i32, invalid_field: *mut *const c_char) -> i32;
    /// Measures the error in the pages that serve what the view sees. `texels_per_pixel`: pages without borders over the pixels of the camera; may be NULL. Otherwise as gnomon_measure.
    pub fn gnomon_measure_pages(plan: *const gnomon_page_plan, view: *const gnomon_view, scene: *const gnomon_scene, options: *const gnomon_measure_options, stats: *mut gnomon_stats, texels_per_pixel: *mut f64, invalid_field: *mut *const c_char) -> i32;
    /// gnomon_expected_error in the pages that serve the points of the picture. A point without a page is drawn as lit.
    pub fn gnomon_expected_page_error(plan: *const gnomon_page_plan, picture: *const gnomon_shadow_picture, pixels: *mut gnomon_wrong_pixels, invalid_field: *mut *const c_char) -> i32;
    /// Entries of the table that gnomon_keep_pages needs; 0 where `slots` is out of range.
    pub fn gnomon_page_table_size(slots: i32) -> i64;
    /// Finds the pages that a pool still holds, and a slot for each of the others. `moved`: boxes of casters that changed since the last call, where they were and where they are. `slots`: the pool, `slot_count` of them, at least one for each page. `table`: gnomon_page_table_size entries. `kept`: one for each page. `*drawn`: pages to draw; may be NULL.
    pub fn gnomon_keep_pages(plan: *const gnomon_page_plan, moved: *const f64, moved_count: i64, slots: *mut gnomon_page_slot, slot_count: i32, table: *mut u32, kept: *mut gnomon_kept_page, drawn: *mut i64, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *request.
    pub fn gnomon_light_request_default(request: *mut gnomon_light_request, size: u32) -> i32;
    /// Fills in defaults. `size`: sizeof *options.
    pub fn gnomon_light_options_default(options: *mut gnomon_light_options, size: u32) -> i32;
    /// Fills in defaults: no room, no light. `size`: sizeof *plan.
    pub fn gnomon_light_plan_default(plan: *mut gnomon_light_plan, size: u32) -> i32;
    /// A new history for up to `lights` lights, or NULL where there is no memory or the number is out of range.
    pub fn gnomon_light_history_create(lights: i64) -> *mut gnomon_light_history;
    /// Frees the history; NULL does nothing.
    pub fn gnomon_light_history_destroy(history: *mut gnomon_light_history);
    /// Exchanges what is remembered of two lights: where their order changes. Indices out of range do nothing.
    pub fn gnomon_light_history_swap(history: *mut gnomon_light_history, a: i64, b: i64);
    /// Forgets one light: where another one takes its index. An index out of range does nothing.
    pub fn gnomon_light_history_forget(history: *mut gnomon_light_history, light: i64);
    /// Bytes of memory that gnomon_plan_lights needs for so many lights and visible points; 0 where either is out of range.
    pub fn gnomon_light_memory(lights: i64, points: i64) -> i64;
    /// Divides the texels of one pool among lights, and chooses which of them are due. `requests`: `count` of them, `request_size` bytes each. `memory`: working memory, `bytes` bytes, at least gnomon_light_memory, aligned to 16. `options`, `history`: NULL for none. Plan each light that is due by gnomon_make_plan with gnomon_light_plan_options.
    pub fn gnomon_plan_lights(view: *const gnomon_view, requests: *const gnomon_light_request, request_size: u32, count: i64, scene: *const gnomon_scene, options: *const gnomon_light_options, history: *mut gnomon_light_history, memory: *mut core::ffi::c_void, bytes: i64, plan: *mut gnomon_light_plan, invalid_field: *mut *const c_char) -> i32;
    /// Options for the plan of one light: maps of its size. `plan_options` comes from gnomon_plan_options_default.
    pub fn gnomon_light_plan_options(options: *const gnomon_light_options, maps: *const gnomon_light_maps, plan_options: *mut gnomon_plan_options, invalid_field: *mut *const c_char) -> i32;
    /// A camera that sees all that a local light can light, for maps that serve several frames. For a directional light, `camera` itself. `round` comes from gnomon_camera_default.
    pub fn gnomon_camera_round(light: *const gnomon_light, camera: *const gnomon_camera, round: *mut gnomon_camera, invalid_field: *mut *const c_char) -> i32;
    /// The pool as the atlas of one light's maps, for gnomon_atlas_from_clip.
    pub fn gnomon_light_atlas(plan: *const gnomon_light_plan, light: i64, atlas: *mut gnomon_atlas, invalid_field: *mut *const c_char) -> i32;
    /// Fills in defaults. `size`: sizeof *clusters.
    pub fn gnomon_light_clusters_default(clusters: *mut gnomon_light_clusters, size: u32) -> i32;
    /// Clusters of an image with these options; 0 for what is out of range.
    pub fn gnomon_cluster_count(camera: *const gnomon_camera, tile_pixels: i32, depth_slices: i32) -> i64;
    /// Bytes of memory that gnomon_cluster_lights needs for so many lights and entries of gnomon_light_clusters::lights; 0 where either is out of range.
    pub fn gnomon_cluster_memory(lights: i64, light_room: i64) -> i64;
    /// Lists the lights that can light a surface in each cluster. Shading by the lists gives the same light as shading by all, as long as a light is zero beyond its range and cone. Cluster (column, row, slice) has the lights lights\[begin\[i\]\] .. lights\[begin\[i + 1\] - 1\], i = (slice * rows + row) * columns + column, with row 0 at the bottom of the image. Suns are in every list. `lights`: `count` of them, `light_size` bytes each. `memory`: working memory, `bytes` bytes, at least gnomon_cluster_memory. Any lists fit: where they would be too long, tiles become larger and slices fewer.
    pub fn gnomon_cluster_lights(camera: *const gnomon_camera, lights: *const gnomon_light, light_size: u32, count: i64, memory: *mut core::ffi::c_void, bytes: i64, clusters: *mut gnomon_light_clusters, invalid_field: *mut *const c_char) -> i32;
}

// Each struct's size, and where its fields lie, as the compiler of C has them (tests/c/layout_test.py).
#[cfg(all(test, target_pointer_width = "64"))]
macro_rules! each_layout {
    ($check:ident) => {
        $check!(gnomon_clip_space, 24, zero_to_one: 0, reversed_z: 4, y_down: 8, left_handed: 12, first_row_at_y_max: 16, reserved: 20);
        $check!(gnomon_camera, 136, size: 0, orthographic: 4, position: 8, forward: 32, up: 56, left: 80, right: 88, bottom: 96, top: 104, near_depth: 112, far_depth: 120, width: 128, height: 132);
        $check!(gnomon_light, 72, size: 0, kind: 4, position: 8, direction: 32, outer_radians: 56, range: 64);
        $check!(gnomon_scene, 56, size: 0, reserved: 4, casters: 8, caster_count: 16, receivers: 24, receiver_count: 32, caster_set: 40, receiver_set: 48);
        $check!(gnomon_visible_depths, 1424, count: 0, min: 1408, max: 1416);
        $check!(gnomon_view, 48, size: 0, reserved: 4, camera: 8, depths: 16, points: 24, normals: 32, point_count: 40);
        $check!(gnomon_plan_options, 488, size: 0, cascades: 4, resolution_max_size: 8, resolution_stable_size_steps: 12, resolution_max_error: 16, resolution_texel_budget: 24, resolution_prune_error: 32, fit: 40, split_scheme: 44, split_lambda: 48, split_pseudo_near: 56, split_range: 64, split_selection: 68, split_given: 72, split_overlap: 128, split_partition: 136, split_face_slices: 140, warp: 144, warp_shape: 148, warp_objective: 152, reserved: 156, warp_focus: 160, warp_focus_weight: 208, warp_planes: 216, cadence_frames: 384, prune: 388, cadence_largest_step: 392, cadence_largest_turn: 400, filter_texels: 408, filter_world: 416, bias_constant_texels: 424, bias_slope_texels: 432, bias_normal_offset_texels: 440, bias_max_slope: 448, light_near_share: 456, clip_space: 464);
        $check!(gnomon_texel_rect, 16, x: 0, y: 4, width: 8, height: 12);
        $check!(gnomon_map, 1712, size: 0, cascade: 4, clip_from_world: 8, clip_from_camera_relative: 136, depth_begin: 200, depth_end: 208, overlap: 216, light_world: 224, width: 256, height: 260, shape: 264, warp: 268, shape_parameters: 272, kappa: 392, texel_world: 400, texel_world_max: 416, depth_range_world: 432, bias_constant: 440, bias_slope: 448, bias_normal_offset: 456, filter_margin_texels: 464, cull_plane_count: 468, cull_planes: 472, select_plane_count: 1496, snap_valid: 1500, select_planes: 1504, snap_x: 1632, snap_y: 1640, snap_depth_near: 1648, snap_depth_far: 1656, snap_texel: 1664, m_s_max: 1680, m_t_max: 1688, m_max: 1696, storage: 1704);
        $check!(gnomon_omission, 32, kind: 0, map: 4, a: 8, b: 16, saves_texels: 24);
        $check!(gnomon_text, 192, what: 0, why: 48);
        $check!(gnomon_plan, 160, size: 0, map_size: 4, maps: 8, omissions: 16, map_room: 24, omission_room: 28, status: 32, map_count: 36, omission_count: 40, selection: 44, sizes_vary: 48, reserved: 52, origin: 56, light_direction: 80, clip_space: 104, bias_constant_texels: 128, bias_slope_texels: 136, bias_normal_offset_texels: 144, bias_max_slope: 152);
        $check!(gnomon_event, 16, kind: 0, map: 4, density_ratio: 8);
        $check!(gnomon_reuse, 64, kind: 0, shift_x: 4, shift_y: 8, strip_count: 12, kept: 16, strip: 32);
        $check!(gnomon_engine_bias, 32, depth: 0, slope_factor: 8, normal_world: 16, units: 24);
        $check!(gnomon_held_sun, 48, direction: 0, error_pixels: 24, turned_pixels: 32, points_capped: 40);
        $check!(gnomon_atlas, 152, width: 0, height: 4, place: 8, count: 136, reserved: 140, efficiency: 144);
        $check!(gnomon_measure_options, 24, size: 0, map: 4, columns: 8, rows: 12, depths: 16, reserved: 20);
        $check!(gnomon_stats, 72, size: 0, reserved: 4, p50: 8, p95: 16, max: 24, mean: 32, share_undersampled: 40, storage: 48, samples: 56, outside: 64);
        $check!(gnomon_point_error, 88, status: 0, reserved: 4, m_max: 8, m_min: 16, m_s: 24, m_t: 32, m_area: 40, anisotropy: 48, perspective_max: 56, perspective_s: 64, perspective_t: 72, projection: 80);
        $check!(gnomon_shadow_picture, 80, size: 0, reserved: 4, camera: 8, mask: 16, view_depths: 24, pixel_count: 32, kernel_texels: 40, occluder_distances: 48, occluder_search: 56, occluder_scene: 64, normals: 72);
        $check!(gnomon_wrong_pixels, 24, wrong: 0, counted: 8, share: 16);
        $check!(gnomon_page_options, 72, size: 0, policy: 4, plan: 8, page_texels: 16, capacity: 20, target_m: 24, share: 32, levels_per_octave: 40, trials: 44, virtual_texels: 48, fallback: 52, reach_texels: 56, least_light_sine: 64);
        $check!(gnomon_page, 20, level: 0, column: 4, row: 8, slot: 12, points: 16);
        $check!(gnomon_page_plan, 200, size: 0, status: 4, omissions: 8, omission_room: 16, omission_count: 20, pages: 24, table: 32, memory: 40, page_count: 48, table_count: 56, level_count: 64, policy: 68, page_texels: 72, border_texels: 76, capacity: 80, reserved: 84, origin: 88, light_direction: 112, clip_space: 136, target_m: 160, points: 168, points_outside: 176, points_coarser: 184, points_capped: 192);
        $check!(gnomon_page_history, 32, size: 0, reserved: 4, last: 8, feedback: 16, feedback_count: 24);
        $check!(gnomon_page_slot, 152, clip_from_world: 0, texels: 128, reserved: 132, used: 136, behind: 144);
        $check!(gnomon_kept_page, 8, slot: 0, draw: 4, compose: 5, reserved: 6);
        $check!(gnomon_light_request, 40, size: 0, changed: 4, light: 8, weight: 16, draws: 24, triangles: 32);
        $check!(gnomon_light_options, 112, size: 0, page_budget: 4, plan: 8, pool_width: 16, pool_height: 20, texel_budget: 24, page_texels: 32, least_size: 36, most_size: 40, most_frames: 44, millisecond_budget: 48, cost_per_map: 56, cost_per_megatexel: 64, cost_per_kilodraw: 72, cost_per_megatriangle: 80, enough_m: 88, full_share: 96, keep_gain: 104);
        $check!(gnomon_light_maps, 168, size: 0, outcome: 4, texels: 8, map_count: 12, place: 16, share: 144, m: 152, frames: 160, due: 164);
        $check!(gnomon_light_plan, 112, size: 0, light_size: 4, lights: 8, light_room: 16, light_count: 24, status: 32, invalid_light: 36, pool_width: 40, pool_height: 44, texels: 48, due_texels: 56, pages: 64, milliseconds: 72, due_milliseconds: 80, error: 88, mapped: 96, due: 100, repacked: 104, reserved: 108);
        $check!(gnomon_light_clusters, 88, size: 0, tile_pixels: 4, depth_slices: 8, status: 12, begin: 16, lights: 24, begin_room: 32, light_room: 40, columns: 48, rows: 52, slices: 56, orthographic: 60, depth_scale: 64, depth_offset: 72, light_count: 80);
    };
}
