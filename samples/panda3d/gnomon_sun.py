"""How does a sun of Panda3D take the shadow map of gnomon? Each frame its lens becomes the matrix of a plan."""
import gnomon
import numpy as np
from panda3d import core as p3


def columns(matrix):
    """A matrix of Panda3D, which acts on row vectors, as gnomon has them."""
    return np.array([matrix.get_row(i) for i in range(4)]).T


def boxes_of(root):
    """(n, 6): bounds of each geometry below a node, in the node's space."""
    corners = (node.get_tight_bounds(root) for node in root.find_all_matches("**/+GeomNode"))
    return np.array([[*least, *most] for least, most in filter(None, corners)])


class GnomonSun:
    """Fits the shadow map of a DirectionalLight to what a camera sees.

    light: its node path, which shines along the light's direction. camera: the node path of the camera that looks.
    root: what casts and receives shadows; its boxes are gathered once, and by gather() again. size: texels along each side.
    options: fields of gnomon.plan, such as fit="stable".
    """

    def __init__(self, light, camera, root, size=1024, **options):
        self.light, self.camera, self.root = light, camera, root
        self.options = {"cascades": 1, "resolution_max_size": size, "fit": "warped_stable", "prune": [], **options}
        self.history, self.plan = gnomon.History(), None
        light.node().set_shadow_caster(True, size, size)
        # The lens of a warped map has no frustum that Panda3D's culling knows.
        light.node().set_cull_bounds(p3.OmniBoundingVolume())
        self.gather()

    def gather(self):
        """Takes the bounds of the scene again, after something was added or moved."""
        self.boxes = boxes_of(self.root)

    def seen(self):
        """The camera as gnomon has it."""
        lens, window = self.camera.node().get_lens(), self.camera.node().get_display_region(0)
        # gnomon takes view spaces along z; those of Panda3D look along y by default.
        turned = p3.LMatrix4.convert_mat(lens.coordinate_system, p3.CS_yup_right)
        back = p3.LMatrix4.convert_mat(p3.CS_yup_right, lens.coordinate_system)
        return gnomon.camera_from(columns(self.root.get_mat(self.camera) * turned), columns(back * lens.get_projection_mat()),
                                  width=window.get_pixel_width(), height=window.get_pixel_height())

    def update(self, task=None):
        """Plans for this frame; also as a task: base.task_mgr.add(sun.update)."""
        direction = self.root.get_relative_vector(self.light, self.light.node().get_direction())
        self.plan = gnomon.plan(self.seen(), gnomon.directional(direction), self.boxes, self.boxes, history=self.history,
                                **self.options)
        for one in self.plan.maps:
            # The lens takes points in the light's space.
            matrix = one.clip_from_world @ columns(self.light.get_mat(self.root))
            lens = p3.MatrixLens()
            lens.set_user_mat(p3.LMatrix4(*matrix.T.ravel()))
            self.light.node().set_lens(lens)
        self.light.node().set_shadow_caster(bool(self.plan.maps))
        return task.cont if task else None
