"""Which uniforms does a draw of a RenderDoc capture have, and what are their values?"""
import re

import renderdoc as rd

STAGES = (rd.ShaderStage.Pixel, rd.ShaderStage.Vertex)


class Fault(Exception):
    """Its text is one line for the user."""


class Uniforms:
    """Names to values, at the draw where the replay stands."""

    def __init__(self, controller):
        state = controller.GetPipelineState()
        self.blocks = []
        for stage in STAGES:
            shader = state.GetShaderReflection(stage)
            if shader is None:
                continue
            for slot, block in enumerate(shader.constantBlocks):
                bound = state.GetConstantBuffer(stage, slot, 0)
                values = controller.GetCBufferVariableContents(
                    state.GetGraphicsPipelineObject(), shader.resourceId, stage, state.GetShaderEntryPoint(stage), slot,
                    bound.resourceId, bound.byteOffset, bound.byteSize)
                self.blocks.append((block.name, values))

    def find(self, name, index=None):
        """The variable, or the number that .x .y .z .w picks from a vector, or None. [] becomes [index]."""
        steps = re.findall(r"\[\d*\]|[^.\[\]]+", name)
        for block, values in self.blocks:
            for rest in (steps, steps[1:] if steps[:1] == [block] else []):
                found = self._down(values, rest, index)
                if found is not None:
                    return found
        return None

    @staticmethod
    def _down(members, steps, index):
        variable = None
        for step in steps:
            if step.startswith("["):
                at = int(step[1:-1]) if step != "[]" else index
                variable = members[at] if at is not None and at < len(members) else None
            elif variable is not None and not members and step in ("x", "y", "z", "w"):
                at = "xyzw".index(step)
                return numbers(variable)[at] if at < variable.columns else None
            else:
                variable = next((v for v in members if v.name == step), None)
            if variable is None:
                return None
            members = variable.members
        return variable

    def elements(self, name):
        """How many maps a name with [] has."""
        count = 0
        while self.find(name, count) is not None:
            count += 1
        return count


def numbers(variable):
    if isinstance(variable, float):
        return [variable]
    if variable.members:
        raise Fault(f"{variable.name} is an array or a struct: say which member, or [] for that of the map")
    kind = {rd.VarType.Float: "f32v", rd.VarType.Double: "f64v", rd.VarType.SInt: "s32v", rd.VarType.UInt: "u32v"}.get(variable.type)
    if kind is None:
        raise Fault(f"{variable.name} is not a number")
    return [float(x) for x in list(getattr(variable.value, kind))[:variable.rows * variable.columns]]


def names_of(variables, prefix=""):
    for variable in variables:
        name = prefix + variable.name
        if not variable.members:
            yield f"{name}  {variable.rows} x {variable.columns}"
        elif variable.members[0].name.endswith("[0]"):
            first = variable.members[0]
            yield from names_of(first.members, name + "[].") if first.members else [f"{name}[]  {first.rows} x {first.columns}, {len(variable.members)} times"]
        else:
            yield from names_of(variable.members, name + ".")


def all_draws(actions):
    for action in actions:
        if action.flags & rd.ActionFlags.Drawcall:
            yield action
        yield from all_draws(action.children)
