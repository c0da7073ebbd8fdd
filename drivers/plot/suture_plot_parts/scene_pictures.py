"""The pictures of a scene before it is solved."""
from .groups import groups_figure
from .picture import Picture, note_on
from .scene import scene_figure
from .words import contacts


def scene_pictures(run, view=None):
    """Yields scene.png and groups.png, in 3D also groups_2.png, ...; as pictures() does."""
    if run.dimension == 3:
        from .space.scene_pages import scene_pages
        yield from scene_pages(run, view)
        return
    figure, left_out = scene_figure(run)
    yield Picture("scene", "mesh", "Loads, supports and contacts." + note_on(left_out), figure)
    yield Picture("groups", "mesh", "Names of all sides.", groups_figure(run))


def unused(run):
    """Names of the side groups that no condition and no contact uses."""
    used = {group for contact in contacts(run) for group in contact.side_a + contact.side_b}
    for given in run.parameter("Boundary Conditions", default={}).values():
        groups = given.get("Group", []) if isinstance(given, dict) else []
        used |= set(groups if isinstance(groups, list) else [groups])
    return [name for name in sorted(run.fields.side_groups) if name not in used]
