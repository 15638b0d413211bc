"""The structs and constants of the C header. Written by bindings/layout.py."""
from __future__ import annotations

import ctypes
from typing import Any

OK = 0
NOTHING_VISIBLE = 1
NO_CASTER = 2
INVALID_INPUT = 3
OUT_OF_MEMORY = 4
MAX_MAPS = 8
MAX_CULL_PLANES = 32
MAX_SELECT_PLANES = 4
MAX_WARP_PLANES = 3
MAX_OMISSIONS = 32
MAX_VIEWS = 8
MAX_LIGHTS = 4096
SHAPE_PARAMETERS = 15
DEPTH_BINS = 352
SHADER_BLOCK_FLOATS = 460
JITTER_FRAMES = 64
WARPS = 0
SHAPES = 1
FITS = 2
SPLITS = 3
PARTITIONS = 4
SELECTIONS = 5
OBJECTIVES = 6
PRUNE_RULES = 7
PAGE_POLICIES = 8
STATUSES = 9
DEFAULT = -1
UNKNOWN = -2
DIRECTIONAL = 0
SPOT = 1
POINT = 2
RANGE_AUTOMATIC = 0
RANGE_RECEIVERS = 1
RANGE_CAMERA = 2
CASCADE_WITHOUT_RECEIVER = 0
CASCADE_WITHOUT_CASTER = 1
DEPTH_WITHOUT_RECEIVER = 2
DEPTH_NOT_VISIBLE = 3
WARP_WITHOUT_GAIN = 4
WARP_IN_STABLE_FIT = 5
PART_WITHOUT_CASTER = 6
PARTITION_WITHOUT_GAIN = 7
PARTITION_IN_STABLE_FIT = 8
FACE_WITHOUT_RECEIVER = 9
FACE_WITHOUT_CASTER = 10
RESOLUTION_WITHOUT_GAIN = 11
DEPTH_NEAR_LIGHT = 12
OPTION_IGNORED = 13
VIEW_WITHOUT_RECEIVER = 14
PAGES_COARSENED = 15
POINTS_LEFT_COARSER = 16
POINTS_BEYOND_LEVELS = 17
SHAPE_WITHOUT_GAIN = 18
PLANE_WITHOUT_RECEIVER = 19
PLANE_WITHOUT_CASTER = 20
CASCADE_ON_PLANES = 21
FACES_LESS_DIVIDED = 22
RECEIVER_NEAR_LIGHT = 23
CASCADE_WITHOUT_GAIN = 24
IGNORED_PARTITION = 0
IGNORED_SPLIT_SCHEME = 1
IGNORED_SPLIT_OVERLAP = 2
IGNORED_VISIBLE_DEPTHS = 3
IGNORED_TEXEL_BUDGET = 4
IGNORED_HISTORY = 5
IGNORED_SELECTION = 6
IGNORED_CADENCE = 7
IGNORED_VISIBLE_POINTS = 8
IGNORED_SHAPE = 9
IGNORED_PLANES = 10
IGNORED_PAGE_SHARE = 11
IGNORED_PAGE_REACH = 12
MAP_APPEARED = 0
MAP_REFITTED = 1
DENSITY_JUMP = 2
REUSE_NONE = 0
REUSE_IDENTICAL = 1
REUSE_SCROLLED = 2
BIAS_RASTERIZER = 0
BIAS_NORMAL_OFFSET = 1
POINT_OK = 0
POINT_OUTSIDE = 1
POINT_FACES_AWAY = 2
POINT_UNDETERMINED = 3
SHADOW_EDGE = 1
SHADOW_CHANGED = 2
DEPTH_EDGE = 4
LIGHT_MAPPED = 0
LIGHT_BELOW_LEAST_SIZE = 1
LIGHT_WITHOUT_RECEIVER = 2
LIGHT_WITHOUT_CASTER = 3

occluder_search: Any = ctypes.CFUNCTYPE(ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)


class clip_space(ctypes.Structure):
    _fields_ = [
        ("zero_to_one", ctypes.c_int32),
        ("reversed_z", ctypes.c_int32),
        ("y_down", ctypes.c_int32),
        ("left_handed", ctypes.c_int32),
        ("first_row_at_y_max", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
    ]
    zero_to_one: int
    reversed_z: int
    y_down: int
    left_handed: int
    first_row_at_y_max: int
    reserved: int


assert ctypes.sizeof(clip_space) == 24


class camera(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("orthographic", ctypes.c_int32),
        ("position", ctypes.c_double * 3),
        ("forward", ctypes.c_double * 3),
        ("up", ctypes.c_double * 3),
        ("left", ctypes.c_double),
        ("right", ctypes.c_double),
        ("bottom", ctypes.c_double),
        ("top", ctypes.c_double),
        ("near_depth", ctypes.c_double),
        ("far_depth", ctypes.c_double),
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
    ]
    size: int
    orthographic: int
    position: ctypes.Array[ctypes.c_double]
    forward: ctypes.Array[ctypes.c_double]
    up: ctypes.Array[ctypes.c_double]
    left: float
    right: float
    bottom: float
    top: float
    near_depth: float
    far_depth: float
    width: int
    height: int


assert ctypes.sizeof(camera) == 136


class light(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("kind", ctypes.c_int32),
        ("position", ctypes.c_double * 3),
        ("direction", ctypes.c_double * 3),
        ("outer_radians", ctypes.c_double),
        ("range", ctypes.c_double),
    ]
    size: int
    kind: int
    position: ctypes.Array[ctypes.c_double]
    direction: ctypes.Array[ctypes.c_double]
    outer_radians: float
    range: float


assert ctypes.sizeof(light) == 72


class scene(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("casters", ctypes.c_void_p),
        ("caster_count", ctypes.c_int64),
        ("receivers", ctypes.c_void_p),
        ("receiver_count", ctypes.c_int64),
        ("caster_set", ctypes.c_void_p),
        ("receiver_set", ctypes.c_void_p),
    ]
    size: int
    reserved: int
    casters: Any
    caster_count: int
    receivers: Any
    receiver_count: int
    caster_set: Any
    receiver_set: Any


assert ctypes.sizeof(scene) == 56


class visible_depths(ctypes.Structure):
    _fields_ = [
        ("count", ctypes.c_uint32 * 352),
        ("min", ctypes.c_double),
        ("max", ctypes.c_double),
    ]
    count: ctypes.Array[ctypes.c_uint32]
    min: float
    max: float


assert ctypes.sizeof(visible_depths) == 1424


class view(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("camera", ctypes.c_void_p),
        ("depths", ctypes.c_void_p),
        ("points", ctypes.c_void_p),
        ("normals", ctypes.c_void_p),
        ("point_count", ctypes.c_int64),
    ]
    size: int
    reserved: int
    camera: Any
    depths: Any
    points: Any
    normals: Any
    point_count: int


assert ctypes.sizeof(view) == 48


class plan_options(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("cascades", ctypes.c_int32),
        ("resolution_max_size", ctypes.c_int32),
        ("resolution_stable_size_steps", ctypes.c_int32),
        ("resolution_max_error", ctypes.c_double),
        ("resolution_texel_budget", ctypes.c_int64),
        ("resolution_prune_error", ctypes.c_double),
        ("fit", ctypes.c_int32),
        ("split_scheme", ctypes.c_int32),
        ("split_lambda", ctypes.c_double),
        ("split_pseudo_near", ctypes.c_double),
        ("split_range", ctypes.c_int32),
        ("split_selection", ctypes.c_int32),
        ("split_given", ctypes.c_double * 7),
        ("split_overlap", ctypes.c_double),
        ("split_partition", ctypes.c_int32),
        ("split_face_slices", ctypes.c_int32),
        ("warp", ctypes.c_int32),
        ("warp_shape", ctypes.c_int32),
        ("warp_objective", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("warp_focus", ctypes.c_double * 6),
        ("warp_focus_weight", ctypes.c_double),
        ("warp_planes", ctypes.c_double * 21),
        ("cadence_frames", ctypes.c_int32),
        ("prune", ctypes.c_uint32),
        ("cadence_largest_step", ctypes.c_double),
        ("cadence_largest_turn", ctypes.c_double),
        ("filter_texels", ctypes.c_double),
        ("filter_world", ctypes.c_double),
        ("bias_constant_texels", ctypes.c_double),
        ("bias_slope_texels", ctypes.c_double),
        ("bias_normal_offset_texels", ctypes.c_double),
        ("bias_max_slope", ctypes.c_double),
        ("light_near_share", ctypes.c_double),
        ("clip_space", clip_space),
    ]
    size: int
    cascades: int
    resolution_max_size: int
    resolution_stable_size_steps: int
    resolution_max_error: float
    resolution_texel_budget: int
    resolution_prune_error: float
    fit: int
    split_scheme: int
    split_lambda: float
    split_pseudo_near: float
    split_range: int
    split_selection: int
    split_given: ctypes.Array[ctypes.c_double]
    split_overlap: float
    split_partition: int
    split_face_slices: int
    warp: int
    warp_shape: int
    warp_objective: int
    reserved: int
    warp_focus: ctypes.Array[ctypes.c_double]
    warp_focus_weight: float
    warp_planes: ctypes.Array[ctypes.c_double]
    cadence_frames: int
    prune: int
    cadence_largest_step: float
    cadence_largest_turn: float
    filter_texels: float
    filter_world: float
    bias_constant_texels: float
    bias_slope_texels: float
    bias_normal_offset_texels: float
    bias_max_slope: float
    light_near_share: float
    clip_space: clip_space


assert ctypes.sizeof(plan_options) == 488


class texel_rect(ctypes.Structure):
    _fields_ = [
        ("x", ctypes.c_int32),
        ("y", ctypes.c_int32),
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
    ]
    x: int
    y: int
    width: int
    height: int


assert ctypes.sizeof(texel_rect) == 16


class map(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("cascade", ctypes.c_int32),
        ("clip_from_world", ctypes.c_double * 16),
        ("clip_from_camera_relative", ctypes.c_float * 16),
        ("depth_begin", ctypes.c_double),
        ("depth_end", ctypes.c_double),
        ("overlap", ctypes.c_double),
        ("light_world", ctypes.c_double * 4),
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
        ("shape", ctypes.c_int32),
        ("warp", ctypes.c_int32),
        ("shape_parameters", ctypes.c_double * 15),
        ("kappa", ctypes.c_double),
        ("texel_world", ctypes.c_double * 2),
        ("texel_world_max", ctypes.c_double * 2),
        ("depth_range_world", ctypes.c_double),
        ("bias_constant", ctypes.c_double),
        ("bias_slope", ctypes.c_double),
        ("bias_normal_offset", ctypes.c_double),
        ("filter_margin_texels", ctypes.c_int32),
        ("cull_plane_count", ctypes.c_int32),
        ("cull_planes", ctypes.c_double * 128),
        ("select_plane_count", ctypes.c_int32),
        ("snap_valid", ctypes.c_int32),
        ("select_planes", ctypes.c_double * 16),
        ("snap_x", ctypes.c_int64),
        ("snap_y", ctypes.c_int64),
        ("snap_depth_near", ctypes.c_int64),
        ("snap_depth_far", ctypes.c_int64),
        ("snap_texel", ctypes.c_double * 2),
        ("m_s_max", ctypes.c_double),
        ("m_t_max", ctypes.c_double),
        ("m_max", ctypes.c_double),
        ("storage", ctypes.c_double),
    ]
    size: int
    cascade: int
    clip_from_world: ctypes.Array[ctypes.c_double]
    clip_from_camera_relative: ctypes.Array[ctypes.c_float]
    depth_begin: float
    depth_end: float
    overlap: float
    light_world: ctypes.Array[ctypes.c_double]
    width: int
    height: int
    shape: int
    warp: int
    shape_parameters: ctypes.Array[ctypes.c_double]
    kappa: float
    texel_world: ctypes.Array[ctypes.c_double]
    texel_world_max: ctypes.Array[ctypes.c_double]
    depth_range_world: float
    bias_constant: float
    bias_slope: float
    bias_normal_offset: float
    filter_margin_texels: int
    cull_plane_count: int
    cull_planes: ctypes.Array[ctypes.c_double]
    select_plane_count: int
    snap_valid: int
    select_planes: ctypes.Array[ctypes.c_double]
    snap_x: int
    snap_y: int
    snap_depth_near: int
    snap_depth_far: int
    snap_texel: ctypes.Array[ctypes.c_double]
    m_s_max: float
    m_t_max: float
    m_max: float
    storage: float


assert ctypes.sizeof(map) == 1712


class omission(ctypes.Structure):
    _fields_ = [
        ("kind", ctypes.c_int32),
        ("map", ctypes.c_int32),
        ("a", ctypes.c_double),
        ("b", ctypes.c_double),
        ("saves_texels", ctypes.c_int64),
    ]
    kind: int
    map: int
    a: float
    b: float
    saves_texels: int


assert ctypes.sizeof(omission) == 32


class text(ctypes.Structure):
    _fields_ = [
        ("what", ctypes.c_char * 48),
        ("why", ctypes.c_char * 144),
    ]
    what: Any
    why: Any


assert ctypes.sizeof(text) == 192


class plan(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("map_size", ctypes.c_uint32),
        ("maps", ctypes.c_void_p),
        ("omissions", ctypes.c_void_p),
        ("map_room", ctypes.c_int32),
        ("omission_room", ctypes.c_int32),
        ("status", ctypes.c_int32),
        ("map_count", ctypes.c_int32),
        ("omission_count", ctypes.c_int32),
        ("selection", ctypes.c_int32),
        ("sizes_vary", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("origin", ctypes.c_double * 3),
        ("light_direction", ctypes.c_double * 3),
        ("clip_space", clip_space),
        ("bias_constant_texels", ctypes.c_double),
        ("bias_slope_texels", ctypes.c_double),
        ("bias_normal_offset_texels", ctypes.c_double),
        ("bias_max_slope", ctypes.c_double),
    ]
    size: int
    map_size: int
    maps: Any
    omissions: Any
    map_room: int
    omission_room: int
    status: int
    map_count: int
    omission_count: int
    selection: int
    sizes_vary: int
    reserved: int
    origin: ctypes.Array[ctypes.c_double]
    light_direction: ctypes.Array[ctypes.c_double]
    clip_space: clip_space
    bias_constant_texels: float
    bias_slope_texels: float
    bias_normal_offset_texels: float
    bias_max_slope: float


assert ctypes.sizeof(plan) == 160


class event(ctypes.Structure):
    _fields_ = [
        ("kind", ctypes.c_int32),
        ("map", ctypes.c_int32),
        ("density_ratio", ctypes.c_double),
    ]
    kind: int
    map: int
    density_ratio: float


assert ctypes.sizeof(event) == 16


class reuse(ctypes.Structure):
    _fields_ = [
        ("kind", ctypes.c_int32),
        ("shift_x", ctypes.c_int32),
        ("shift_y", ctypes.c_int32),
        ("strip_count", ctypes.c_int32),
        ("kept", texel_rect),
        ("strip", texel_rect * 2),
    ]
    kind: int
    shift_x: int
    shift_y: int
    strip_count: int
    kept: texel_rect
    strip: Any


assert ctypes.sizeof(reuse) == 64


class engine_bias(ctypes.Structure):
    _fields_ = [
        ("depth", ctypes.c_double),
        ("slope_factor", ctypes.c_double),
        ("normal_world", ctypes.c_double),
        ("units", ctypes.c_double),
    ]
    depth: float
    slope_factor: float
    normal_world: float
    units: float


assert ctypes.sizeof(engine_bias) == 32


class held_sun(ctypes.Structure):
    _fields_ = [
        ("direction", ctypes.c_double * 3),
        ("error_pixels", ctypes.c_double),
        ("turned_pixels", ctypes.c_double),
        ("points_capped", ctypes.c_int64),
    ]
    direction: ctypes.Array[ctypes.c_double]
    error_pixels: float
    turned_pixels: float
    points_capped: int


assert ctypes.sizeof(held_sun) == 48


class atlas(ctypes.Structure):
    _fields_ = [
        ("width", ctypes.c_int32),
        ("height", ctypes.c_int32),
        ("place", texel_rect * 8),
        ("count", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("efficiency", ctypes.c_double),
    ]
    width: int
    height: int
    place: Any
    count: int
    reserved: int
    efficiency: float


assert ctypes.sizeof(atlas) == 152


class measure_options(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("map", ctypes.c_int32),
        ("columns", ctypes.c_int32),
        ("rows", ctypes.c_int32),
        ("depths", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
    ]
    size: int
    map: int
    columns: int
    rows: int
    depths: int
    reserved: int


assert ctypes.sizeof(measure_options) == 24


class stats(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("p50", ctypes.c_double),
        ("p95", ctypes.c_double),
        ("max", ctypes.c_double),
        ("mean", ctypes.c_double),
        ("share_undersampled", ctypes.c_double),
        ("storage", ctypes.c_double),
        ("samples", ctypes.c_int64),
        ("outside", ctypes.c_int64),
    ]
    size: int
    reserved: int
    p50: float
    p95: float
    max: float
    mean: float
    share_undersampled: float
    storage: float
    samples: int
    outside: int


assert ctypes.sizeof(stats) == 72


class point_error(ctypes.Structure):
    _fields_ = [
        ("status", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("m_max", ctypes.c_double),
        ("m_min", ctypes.c_double),
        ("m_s", ctypes.c_double),
        ("m_t", ctypes.c_double),
        ("m_area", ctypes.c_double),
        ("anisotropy", ctypes.c_double),
        ("perspective_max", ctypes.c_double),
        ("perspective_s", ctypes.c_double),
        ("perspective_t", ctypes.c_double),
        ("projection", ctypes.c_double),
    ]
    status: int
    reserved: int
    m_max: float
    m_min: float
    m_s: float
    m_t: float
    m_area: float
    anisotropy: float
    perspective_max: float
    perspective_s: float
    perspective_t: float
    projection: float


assert ctypes.sizeof(point_error) == 88


class shadow_picture(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("camera", ctypes.c_void_p),
        ("mask", ctypes.c_void_p),
        ("view_depths", ctypes.c_void_p),
        ("pixel_count", ctypes.c_int64),
        ("kernel_texels", ctypes.c_double),
        ("occluder_distances", ctypes.c_void_p),
        ("occluder_search", ctypes.c_void_p),
        ("occluder_scene", ctypes.c_void_p),
        ("normals", ctypes.c_void_p),
    ]
    size: int
    reserved: int
    camera: Any
    mask: Any
    view_depths: Any
    pixel_count: int
    kernel_texels: float
    occluder_distances: Any
    occluder_search: Any
    occluder_scene: Any
    normals: Any


assert ctypes.sizeof(shadow_picture) == 80


class wrong_pixels(ctypes.Structure):
    _fields_ = [
        ("wrong", ctypes.c_double),
        ("counted", ctypes.c_double),
        ("share", ctypes.c_double),
    ]
    wrong: float
    counted: float
    share: float


assert ctypes.sizeof(wrong_pixels) == 24


class page_options(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("policy", ctypes.c_int32),
        ("plan", ctypes.c_void_p),
        ("page_texels", ctypes.c_int32),
        ("capacity", ctypes.c_int32),
        ("target_m", ctypes.c_double),
        ("share", ctypes.c_double),
        ("levels_per_octave", ctypes.c_int32),
        ("trials", ctypes.c_int32),
        ("virtual_texels", ctypes.c_int32),
        ("fallback", ctypes.c_int32),
        ("reach_texels", ctypes.c_double),
        ("least_light_sine", ctypes.c_double),
    ]
    size: int
    policy: int
    plan: Any
    page_texels: int
    capacity: int
    target_m: float
    share: float
    levels_per_octave: int
    trials: int
    virtual_texels: int
    fallback: int
    reach_texels: float
    least_light_sine: float


assert ctypes.sizeof(page_options) == 72


class page(ctypes.Structure):
    _fields_ = [
        ("level", ctypes.c_uint32),
        ("column", ctypes.c_int32),
        ("row", ctypes.c_int32),
        ("slot", ctypes.c_uint32),
        ("points", ctypes.c_uint32),
    ]
    level: int
    column: int
    row: int
    slot: int
    points: int


assert ctypes.sizeof(page) == 20


class page_plan(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("status", ctypes.c_int32),
        ("omissions", ctypes.c_void_p),
        ("omission_room", ctypes.c_int32),
        ("omission_count", ctypes.c_int32),
        ("pages", ctypes.c_void_p),
        ("table", ctypes.c_void_p),
        ("memory", ctypes.c_void_p),
        ("page_count", ctypes.c_int64),
        ("table_count", ctypes.c_int64),
        ("level_count", ctypes.c_int32),
        ("policy", ctypes.c_int32),
        ("page_texels", ctypes.c_int32),
        ("border_texels", ctypes.c_int32),
        ("capacity", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("origin", ctypes.c_double * 3),
        ("light_direction", ctypes.c_double * 3),
        ("clip_space", clip_space),
        ("target_m", ctypes.c_double),
        ("points", ctypes.c_int64),
        ("points_outside", ctypes.c_int64),
        ("points_coarser", ctypes.c_int64),
        ("points_capped", ctypes.c_int64),
    ]
    size: int
    status: int
    omissions: Any
    omission_room: int
    omission_count: int
    pages: Any
    table: Any
    memory: Any
    page_count: int
    table_count: int
    level_count: int
    policy: int
    page_texels: int
    border_texels: int
    capacity: int
    reserved: int
    origin: ctypes.Array[ctypes.c_double]
    light_direction: ctypes.Array[ctypes.c_double]
    clip_space: clip_space
    target_m: float
    points: int
    points_outside: int
    points_coarser: int
    points_capped: int


assert ctypes.sizeof(page_plan) == 200


class page_history(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("last", ctypes.c_void_p),
        ("feedback", ctypes.c_void_p),
        ("feedback_count", ctypes.c_int64),
    ]
    size: int
    reserved: int
    last: Any
    feedback: Any
    feedback_count: int


assert ctypes.sizeof(page_history) == 32


class page_slot(ctypes.Structure):
    _fields_ = [
        ("clip_from_world", ctypes.c_double * 16),
        ("texels", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
        ("used", ctypes.c_uint64),
        ("behind", ctypes.c_uint64),
    ]
    clip_from_world: ctypes.Array[ctypes.c_double]
    texels: int
    reserved: int
    used: int
    behind: int


assert ctypes.sizeof(page_slot) == 152


class kept_page(ctypes.Structure):
    _fields_ = [
        ("slot", ctypes.c_uint32),
        ("draw", ctypes.c_uint8),
        ("compose", ctypes.c_uint8),
        ("reserved", ctypes.c_uint8 * 2),
    ]
    slot: int
    draw: int
    compose: int
    reserved: ctypes.Array[ctypes.c_uint8]


assert ctypes.sizeof(kept_page) == 8


class light_request(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("changed", ctypes.c_int32),
        ("light", ctypes.c_void_p),
        ("weight", ctypes.c_double),
        ("draws", ctypes.c_double),
        ("triangles", ctypes.c_double),
    ]
    size: int
    changed: int
    light: Any
    weight: float
    draws: float
    triangles: float


assert ctypes.sizeof(light_request) == 40


class light_options(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("page_budget", ctypes.c_int32),
        ("plan", ctypes.c_void_p),
        ("pool_width", ctypes.c_int32),
        ("pool_height", ctypes.c_int32),
        ("texel_budget", ctypes.c_int64),
        ("page_texels", ctypes.c_int32),
        ("least_size", ctypes.c_int32),
        ("most_size", ctypes.c_int32),
        ("most_frames", ctypes.c_int32),
        ("millisecond_budget", ctypes.c_double),
        ("cost_per_map", ctypes.c_double),
        ("cost_per_megatexel", ctypes.c_double),
        ("cost_per_kilodraw", ctypes.c_double),
        ("cost_per_megatriangle", ctypes.c_double),
        ("enough_m", ctypes.c_double),
        ("full_share", ctypes.c_double),
        ("keep_gain", ctypes.c_double),
    ]
    size: int
    page_budget: int
    plan: Any
    pool_width: int
    pool_height: int
    texel_budget: int
    page_texels: int
    least_size: int
    most_size: int
    most_frames: int
    millisecond_budget: float
    cost_per_map: float
    cost_per_megatexel: float
    cost_per_kilodraw: float
    cost_per_megatriangle: float
    enough_m: float
    full_share: float
    keep_gain: float


assert ctypes.sizeof(light_options) == 112


class light_maps(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("outcome", ctypes.c_int32),
        ("texels", ctypes.c_int32),
        ("map_count", ctypes.c_int32),
        ("place", texel_rect * 8),
        ("share", ctypes.c_double),
        ("m", ctypes.c_double),
        ("frames", ctypes.c_int32),
        ("due", ctypes.c_int32),
    ]
    size: int
    outcome: int
    texels: int
    map_count: int
    place: Any
    share: float
    m: float
    frames: int
    due: int


assert ctypes.sizeof(light_maps) == 168


class light_plan(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("light_size", ctypes.c_uint32),
        ("lights", ctypes.c_void_p),
        ("light_room", ctypes.c_int64),
        ("light_count", ctypes.c_int64),
        ("status", ctypes.c_int32),
        ("invalid_light", ctypes.c_int32),
        ("pool_width", ctypes.c_int32),
        ("pool_height", ctypes.c_int32),
        ("texels", ctypes.c_int64),
        ("due_texels", ctypes.c_int64),
        ("pages", ctypes.c_int64),
        ("milliseconds", ctypes.c_double),
        ("due_milliseconds", ctypes.c_double),
        ("error", ctypes.c_double),
        ("mapped", ctypes.c_int32),
        ("due", ctypes.c_int32),
        ("repacked", ctypes.c_int32),
        ("reserved", ctypes.c_int32),
    ]
    size: int
    light_size: int
    lights: Any
    light_room: int
    light_count: int
    status: int
    invalid_light: int
    pool_width: int
    pool_height: int
    texels: int
    due_texels: int
    pages: int
    milliseconds: float
    due_milliseconds: float
    error: float
    mapped: int
    due: int
    repacked: int
    reserved: int


assert ctypes.sizeof(light_plan) == 112


class light_clusters(ctypes.Structure):
    _fields_ = [
        ("size", ctypes.c_uint32),
        ("tile_pixels", ctypes.c_int32),
        ("depth_slices", ctypes.c_int32),
        ("status", ctypes.c_int32),
        ("begin", ctypes.c_void_p),
        ("lights", ctypes.c_void_p),
        ("begin_room", ctypes.c_int64),
        ("light_room", ctypes.c_int64),
        ("columns", ctypes.c_int32),
        ("rows", ctypes.c_int32),
        ("slices", ctypes.c_int32),
        ("orthographic", ctypes.c_int32),
        ("depth_scale", ctypes.c_double),
        ("depth_offset", ctypes.c_double),
        ("light_count", ctypes.c_int64),
    ]
    size: int
    tile_pixels: int
    depth_slices: int
    status: int
    begin: Any
    lights: Any
    begin_room: int
    light_room: int
    columns: int
    rows: int
    slices: int
    orthographic: int
    depth_scale: float
    depth_offset: float
    light_count: int


assert ctypes.sizeof(light_clusters) == 88

# What each call returns, and its parameters.
calls: dict[str, tuple[Any, list[tuple[str, Any]]]] = {
    "gnomon_count": (ctypes.c_int32, [("list", ctypes.c_int32)]),
    "gnomon_name": (ctypes.c_char_p, [("list", ctypes.c_int32), ("index", ctypes.c_int32)]),
    "gnomon_summary": (ctypes.c_char_p, [("list", ctypes.c_int32), ("index", ctypes.c_int32)]),
    "gnomon_find": (ctypes.c_int32, [("list", ctypes.c_int32), ("name", ctypes.c_char_p)]),
    "gnomon_version": (ctypes.c_char_p, []),
    "gnomon_camera_default": (ctypes.c_int32, [("camera", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_perspective": (ctypes.c_int32, [("camera", ctypes.c_void_p), ("fov_y", ctypes.c_double), ("aspect", ctypes.c_double), ("near_depth", ctypes.c_double), ("far_depth", ctypes.c_double), ("width", ctypes.c_int32), ("height", ctypes.c_int32), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_orthographic": (ctypes.c_int32, [("camera", ctypes.c_void_p), ("height_world", ctypes.c_double), ("aspect", ctypes.c_double), ("near_depth", ctypes.c_double), ("far_depth", ctypes.c_double), ("width", ctypes.c_int32), ("height", ctypes.c_int32), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_camera_from": (ctypes.c_int32, [("view_from_world", ctypes.c_void_p), ("clip_from_view", ctypes.c_void_p), ("clip_space", ctypes.c_void_p), ("width", ctypes.c_int32), ("height", ctypes.c_int32), ("camera", ctypes.c_void_p), ("why", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_texture_from_clip": (ctypes.c_int32, [("clip_space", ctypes.c_void_p), ("texture_from_clip", ctypes.c_void_p)]),
    "gnomon_light_default": (ctypes.c_int32, [("light", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_caster_set_create": (ctypes.c_int32, [("boxes", ctypes.c_void_p), ("count", ctypes.c_int64), ("set", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_caster_set_destroy": (None, [("set", ctypes.c_void_p)]),
    "gnomon_caster_set_count": (ctypes.c_int64, [("set", ctypes.c_void_p)]),
    "gnomon_caster_set_refit": (ctypes.c_int32, [("set", ctypes.c_void_p), ("boxes", ctypes.c_void_p), ("count", ctypes.c_int64), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_caster_set_update": (ctypes.c_int32, [("set", ctypes.c_void_p), ("index", ctypes.c_int64), ("box", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_scene_default": (ctypes.c_int32, [("scene", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_visible_depths_clear": (None, [("depths", ctypes.c_void_p)]),
    "gnomon_visible_depths_add": (ctypes.c_int32, [("depths", ctypes.c_void_p), ("view_depths", ctypes.c_void_p), ("count", ctypes.c_int64), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_view_default": (ctypes.c_int32, [("view", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_depth_tracker_create": (ctypes.c_void_p, [("frames_per_bin", ctypes.c_int32), ("hold_frames", ctypes.c_int32)]),
    "gnomon_depth_tracker_destroy": (None, [("tracker", ctypes.c_void_p)]),
    "gnomon_depth_tracker_clear": (None, [("tracker", ctypes.c_void_p)]),
    "gnomon_depth_tracker_update": (ctypes.c_int32, [("tracker", ctypes.c_void_p), ("frame", ctypes.c_void_p), ("depths", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_plan_options_default": (ctypes.c_int32, [("options", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_map_default": (ctypes.c_int32, [("map", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_describe": (None, [("omission", ctypes.c_void_p), ("text", ctypes.c_void_p)]),
    "gnomon_plan_default": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_history_create": (ctypes.c_void_p, []),
    "gnomon_history_destroy": (None, [("history", ctypes.c_void_p)]),
    "gnomon_history_clear": (None, [("history", ctypes.c_void_p)]),
    "gnomon_history_copy": (None, [("from", ctypes.c_void_p), ("to", ctypes.c_void_p)]),
    "gnomon_history_events": (ctypes.c_int32, [("history", ctypes.c_void_p), ("events", ctypes.c_void_p), ("room", ctypes.c_int32)]),
    "gnomon_make_plan": (ctypes.c_int32, [("view", ctypes.c_void_p), ("light", ctypes.c_void_p), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("history", ctypes.c_void_p), ("plan", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_plan_views": (ctypes.c_int32, [("cameras", ctypes.c_void_p), ("count", ctypes.c_int32), ("light", ctypes.c_void_p), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("plan", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_select": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("points", ctypes.c_void_p), ("view_depths", ctypes.c_void_p), ("count", ctypes.c_int64), ("indices", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_cull": (ctypes.c_int32, [("map", ctypes.c_void_p), ("casters", ctypes.c_void_p), ("count", ctypes.c_int64), ("indices", ctypes.c_void_p), ("room", ctypes.c_int64), ("found", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_cull_set": (ctypes.c_int32, [("map", ctypes.c_void_p), ("set", ctypes.c_void_p), ("indices", ctypes.c_void_p), ("room", ctypes.c_int64), ("found", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_cull_planes": (ctypes.c_int32, [("planes", ctypes.c_void_p), ("plane_count", ctypes.c_int32), ("set", ctypes.c_void_p), ("indices", ctypes.c_void_p), ("room", ctypes.c_int64), ("found", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_rebased": (ctypes.c_int32, [("map", ctypes.c_void_p), ("origin", ctypes.c_void_p), ("to", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_compare": (ctypes.c_int32, [("previous", ctypes.c_void_p), ("current", ctypes.c_void_p), ("clip_space", ctypes.c_void_p), ("reuse", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_rectangle_planes": (ctypes.c_int32, [("map", ctypes.c_void_p), ("rectangle", ctypes.c_void_p), ("clip_space", ctypes.c_void_p), ("planes", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_shader_block": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("layer_width", ctypes.c_int32), ("layer_height", ctypes.c_int32), ("blur_texels", ctypes.c_double), ("block", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_translate_bias": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("map", ctypes.c_int32), ("way", ctypes.c_int32), ("kernel_radius_texels", ctypes.c_double), ("depth_bits", ctypes.c_int32), ("bias", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_jitter_texels": (ctypes.c_int32, [("frame", ctypes.c_uint32), ("offset", ctypes.c_void_p)]),
    "gnomon_jitter": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("offset", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_hold_sun": (ctypes.c_int32, [("view", ctypes.c_void_p), ("held", ctypes.c_void_p), ("sun", ctypes.c_void_p), ("casters", ctypes.c_void_p), ("most_pixels", ctypes.c_double), ("least_light_sine", ctypes.c_double), ("result", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_pack_atlas": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("width", ctypes.c_int32), ("height", ctypes.c_int32), ("atlas", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_atlas_from_clip": (ctypes.c_int32, [("atlas", ctypes.c_void_p), ("clip_space", ctypes.c_void_p), ("map", ctypes.c_int32), ("atlas_from_clip", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_measure_options_default": (ctypes.c_int32, [("options", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_stats_default": (ctypes.c_int32, [("stats", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_measure": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("view", ctypes.c_void_p), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("stats", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_measure_points": (ctypes.c_int32, [("map", ctypes.c_void_p), ("camera", ctypes.c_void_p), ("points", ctypes.c_void_p), ("normals", ctypes.c_void_p), ("count", ctypes.c_int64), ("errors", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_shadow_picture_default": (ctypes.c_int32, [("picture", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_expected_error": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("picture", ctypes.c_void_p), ("pixels", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_shadow_edge_points": (ctypes.c_int32, [("picture", ctypes.c_void_p), ("points", ctypes.c_void_p), ("room", ctypes.c_int64), ("written", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_page_options_default": (ctypes.c_int32, [("options", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_page_plan_default": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_page_history_default": (ctypes.c_int32, [("history", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_page_memory": (ctypes.c_int64, [("capacity", ctypes.c_int32), ("points", ctypes.c_int64)]),
    "gnomon_plan_pages": (ctypes.c_int32, [("view", ctypes.c_void_p), ("light", ctypes.c_void_p), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("history", ctypes.c_void_p), ("memory", ctypes.c_void_p), ("bytes", ctypes.c_int64), ("plan", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_page_level": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("level", ctypes.c_int32), ("map", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_page_map": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("page", ctypes.c_int64), ("map", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_page_select": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("points", ctypes.c_void_p), ("count", ctypes.c_int64), ("indices", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_measure_pages": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("view", ctypes.c_void_p), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("stats", ctypes.c_void_p), ("texels_per_pixel", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_expected_page_error": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("picture", ctypes.c_void_p), ("pixels", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_page_table_size": (ctypes.c_int64, [("slots", ctypes.c_int32)]),
    "gnomon_keep_pages": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("moved", ctypes.c_void_p), ("moved_count", ctypes.c_int64), ("slots", ctypes.c_void_p), ("slot_count", ctypes.c_int32), ("table", ctypes.c_void_p), ("kept", ctypes.c_void_p), ("drawn", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_light_request_default": (ctypes.c_int32, [("request", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_light_options_default": (ctypes.c_int32, [("options", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_light_plan_default": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_light_history_create": (ctypes.c_void_p, [("lights", ctypes.c_int64)]),
    "gnomon_light_history_destroy": (None, [("history", ctypes.c_void_p)]),
    "gnomon_light_history_swap": (None, [("history", ctypes.c_void_p), ("a", ctypes.c_int64), ("b", ctypes.c_int64)]),
    "gnomon_light_history_forget": (None, [("history", ctypes.c_void_p), ("light", ctypes.c_int64)]),
    "gnomon_light_memory": (ctypes.c_int64, [("lights", ctypes.c_int64), ("points", ctypes.c_int64)]),
    "gnomon_plan_lights": (ctypes.c_int32, [("view", ctypes.c_void_p), ("requests", ctypes.c_void_p), ("request_size", ctypes.c_uint32), ("count", ctypes.c_int64), ("scene", ctypes.c_void_p), ("options", ctypes.c_void_p), ("history", ctypes.c_void_p), ("memory", ctypes.c_void_p), ("bytes", ctypes.c_int64), ("plan", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_light_plan_options": (ctypes.c_int32, [("options", ctypes.c_void_p), ("maps", ctypes.c_void_p), ("plan_options", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_camera_round": (ctypes.c_int32, [("light", ctypes.c_void_p), ("camera", ctypes.c_void_p), ("round", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_light_atlas": (ctypes.c_int32, [("plan", ctypes.c_void_p), ("light", ctypes.c_int64), ("atlas", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
    "gnomon_light_clusters_default": (ctypes.c_int32, [("clusters", ctypes.c_void_p), ("size", ctypes.c_uint32)]),
    "gnomon_cluster_count": (ctypes.c_int64, [("camera", ctypes.c_void_p), ("tile_pixels", ctypes.c_int32), ("depth_slices", ctypes.c_int32)]),
    "gnomon_cluster_memory": (ctypes.c_int64, [("lights", ctypes.c_int64), ("light_room", ctypes.c_int64)]),
    "gnomon_cluster_lights": (ctypes.c_int32, [("camera", ctypes.c_void_p), ("lights", ctypes.c_void_p), ("light_size", ctypes.c_uint32), ("count", ctypes.c_int64), ("memory", ctypes.c_void_p), ("bytes", ctypes.c_int64), ("clusters", ctypes.c_void_p), ("invalid_field", ctypes.c_void_p)]),
}
