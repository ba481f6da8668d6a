"""Words of authored names that are not objects: words that tools, artists and level designers add to the noun."""

from __future__ import annotations

from collections.abc import Iterator


def _set(text: str) -> frozenset[str]:
    return frozenset(text.split())


TOOL_WORDS = _set("""
    sm sk st bp prop props mesh mtl geo geom geometry grp group node obj object objects model models prefab prefabs inst
    instance instanced lod lods col coll collider collision ucx ubx usp static dynamic root body part parts piece main
    copy clone final test tmp temp default base bake baked poly lowpoly highpoly hd lp hp fbx glb gltf stl dae blend usd
    usdz ply asset assets pack kit item items variant var version ver rig rigged skinned skeleton armature bone empty
    null pivot ctrl locator helper dummy xform transform matrix scene level world env environment interior exterior mat
    material materials texture tex uv primitive prim submesh element component entity actor planforge sketchfab unity
    unreal untitled noname unnamed link joint
    cube cylinder sphere icosphere uvsphere circle plane cone torus capsule quad curve line polygon surface shape bezier
    nurbs text point
""")
"""Words of exporters, engines and modelling tools, without information about the object."""

MODIFIERS = _set("""
    left right upper lower top bottom front back rear side middle center centre corner inner outer outside end
    straight half double single triple twin standing hanging mounted built builtin tall short long wide
    narrow big small large little medium huge tiny mini xl xs giant high low mid thick thin round rounded square
    rectangle rectangular oval circular flat curved cross folding foldable foldout stacked vertical horizontal diagonal
    standalone freestanding portable mobile electric electrical electronic automatic manual digital analog cordless
    industrial commercial professional motorized motorised powered
    dark light bright colored coloured
    old new vintage antique modern classic retro fancy simple basic plain cheap luxury design designer deluxe rustic
    scandinavian victorian decorative decorated ornate style stylized stylised realistic clean dirty messy broken
    damaged rusty worn used empty full filled stuffed open opened closed shut locked on off active idle running ringing
    boiling cooking cooked uncooked raw mashed chopped sliced slice slices rings pieces chunk cut fresh rotten burnt hot
    cold warm wet dry relax cozy comfy
    room house home hotel restaurant apartment balcony indoor outdoor hall hallway corridor entrance lobby
    dining school hospital shop store public private
    kids child children baby adult men women his her my
    order multi patch pile stack heap bunch row pair seater
""")
"""Words for position, size, colour, state or owner. The object is the noun beside them."""

KINDS = _set(
    "electric electrical electronic automatic digital motorized motorised powered cordless circular folding hanging"
)
"""Modifiers that name a kind of object behind it too (wheelchair_electric), unlike a side (loader_front)."""

SOUNDING = {
    "purring": ("purring", 0.15),
    "ticking": ("ticking", 0.1),
    "dripping": ("dripping", 0.08),
    "flowing": ("flowing", 0.15),
    "flushing": ("flushing", 0.2),
    "humming": ("humming", 0.1),
    "buzzing": ("buzzing", 0.2),
    "hissing": ("hissing", 0.15),
    "crackling": ("crackling", 0.1),
    "bubbling": ("bubbling", 0.2),
    "rattling": ("rattling", 0.3),
    "rumbling": ("rumbling", 0.3),
    "throbbing": ("throbbing", 0.3),
    "shaking": ("shaking", 0.4),
    "trembling": ("shaking", 0.3),
    "vibrating": ("shaking", 0.4),
    "motorized": ("moving", 0.2),
    "motorised": ("moving", 0.2),
}
"""Words that say what an object does that is silent by itself, as in "purring cat" -> its state, and the intensity of
that (assumed). Not those that also name a kind of object, as rolling pins, rocking chairs and running shoes do."""

COLOURS = _set("""
    red green blue yellow orange white black gray grey brown pink purple beige cream golden gold silver turquoise
""")
"""Colours. After "light" they name a shade ("light_blue"), not a lamp."""

PLACE_WORDS = {
    "kitchen": "kitchen",
    "kitchenette": "kitchen",
    "bathroom": "bathroom",
    "restroom": "bathroom",
    "washroom": "bathroom",
    "laundry": "laundry",
    "livingroom": "living-room",
    "living": "living-room",
    "lounge": "living-room",
    "bedroom": "bedroom",
    "office": "office",
    "workplace": "office",
    "workshop": "workshop",
    "garage": "workshop",
    "garden": "garden",
    "yard": "garden",
    "backyard": "garden",
    "construction": "building-site",
    "hospital": "hospital",
    "clinic": "hospital",
    "ward": "hospital",
    "surgery": "hospital",
    "warehouse": "warehouse",
    "street": "street",
    "city": "street",
    "gym": "gym",
    "fitness": "gym",
}
"""Words that name a place, in names of objects and scenes."""

STUFFED = frozenset({"stuffed", "plush", "cuddly"})
"""Words that say of an animal that it is a toy. A "stuffed pepper" is food."""

TOY_WORDS = frozenset({"toy", "miniature", "replica", "fake"})
"""Words before a noun that mark an unreal object. "mini" is not among them: a mini fridge is a fridge."""

_MATERIALS = _set("""
    steel iron aluminum aluminium copper brass bronze glass plastic ceramic porcelain marble granite concrete brick
    stone oak pine spruce beech birch walnut maple teak mahogany bamboo plywood mdf cork leather fabric cotton rubber
    silicone vinyl pvc acrylic terracotta slate limestone sandstone wood metal cardboard linoleum plexiglass
""")

MATERIAL_WORDS = {
    **{word: word for word in _MATERIALS},
    "wooden": "wood",
    "stainless": "stainless steel",
    "cast": "cast iron",
    "metallic": "metal",
    "chrome": "steel",
    "tiled": "ceramic",
    "velvet": "fabric",
    "linen": "fabric",
    "wicker": "bamboo",
    "rattan": "bamboo",
    "alu": "aluminum",
    "inox": "stainless steel",
    "cement": "concrete",
    "textile": "fabric",
    "wool": "fabric",
    "denim": "fabric",
    "foam": "foam",
    "tin": "steel",
    "canvas": "fabric",
    "silk": "fabric",
    "jute": "fabric",
    "suede": "leather",
    "galvanized": "steel",
    "galvanised": "steel",
    "wrought": "cast iron",
    "stoneware": "ceramic",
    "perspex": "plexiglass",
    "plush": "fabric",
    "stuffed": "fabric",
}
"""Adjectives of material -> a name in the material table. Colours that are metals (gold, silver) are left out."""

PAINT_WORDS = {
    **MATERIAL_WORDS,
    "timber": "wood",
    "laminate": "laminate",
    "tile": "ceramic",
    "tiles": "ceramic",
    "china": "porcelain",
    "mirror": "glass",
    "plaster": "plaster",
    "stucco": "plaster",
    "asphalt": "asphalt",
    "cloth": "fabric",
    "carpet": "carpet",
    "paper": "paper",
    "nylon": "nylon",
}
"""Words in the names of surface materials. In the names of objects, some of these words are objects."""

MATERIAL_NOUNS = frozenset({"glass", "paper", "brick", "stone"})
"""Nouns that name a material after another noun (tableGlass), not another object."""

GENERAL_NOUNS = frozenset({"machine"})
"""Nouns whose neighbour names the kind of the object in either order: coffee machine, machine_coffee. After a machine
they say nothing more: a "bread slicer machine" is a bread slicer."""

LEFTOVER_NOUNS = _set("mat trash orange cream mobile house backsplash splashback wc goal")
"""Nouns that are no objects after another noun. Exporters write "Burner_mat_0", designers "ham_trash" and
"sofa_orange". A "counter_backsplash" is a counter with a backsplash, a "mirror_wc" hangs in one, and a "bin_goal" is
where a task of a robot ends."""

ROOM_NOUNS = _set("bath")
"""Nouns that name the room after another noun: a "scale_bath" is no bathtub."""

NO_MACHINES = _set("""
    room house bay station depot pit shed area zone spot spawn volume trigger waypoint
    lane track tunnel platform stop shelter park parking dealer dealership
    driver pilot owner operator repair service wash software memory
    art file icon guide instruction license shadow outline stencil
    plan schedule sketch symbol emblem badge tag bill permit pass recipe
    control console channel sensor fuse chuck kit pad seal strip
    sheet film guard holster head tip sleeve mitt wrap foot nose tail inlet intake meter indicator trim spare support
    fuel lint dust waste smoke steam sound noise ash crumb pod grease wax lube polish coolant rag
    debris fragment gib husk ruin wreckage
""")
"""Words directly after a machine, or last after it, that say that the object is another one: the place around it
(engine_room), a person (helicopter_pilot), a text or picture (blender_file, fan_art), a thing of it (crane_control,
drill_kit), what it takes in or gives off (oven_grease), or its remains (car_wreckage)."""

COUNTED = frozenset({"seat", "cushion", "pillow", "shelf", "stove burner"})
"""Nouns besides parts that count something of the noun before them: a "sofa 2 seats" is a sofa."""

ROBOT_JOINTS = _set("""
    shoulder elbow forearm upperarm wrist waist torso pelvis hip thigh shin calf knee ankle finger thumb knuckle gripper
    flange metacarpal proximal distal
""")
"""Words beside "link", "joint" or an axis that name a part of a robot: wrist_3_link, elbow_flex."""

ROBOT_AXES = _set("roll pitch yaw pan lift flex")
"""Words for the motion of a robot's joint."""

ROBOT_NOUNS = {
    **dict.fromkeys(("roll", "pan", "lift"), ROBOT_JOINTS | {"link", "joint", "robot"}),
    "palm": frozenset({"link", "joint", "robot", "hand", "gripper", "rh", "lh"}),
    "panda": frozenset({"link", "joint", "hand", "finger", "leftfinger", "rightfinger", "gripper", "flange"}),
}
"""Nouns that name a robot's joint, hand or make beside one of these words: a "shoulder_pan_link" is no frying pan, a
"Wrist_Pitch_Roll" no bread, a "rh_palm" no tree, and a "panda_link3" no animal."""

ROBOT_LIMBS = dict.fromkeys(("arm", "leg"), frozenset({"link", "joint", "upper", "lower"}))
"""Nouns that name a robot's limb beside one of these words: "FL_upper_leg" is no leg of a table."""

LINK_NOUNS = _set("screen display mount bracelet")
"""Nouns that name a link in the chain of a robot, as the screen of a Sawyer; alone they are other objects."""

ROBOT_MAKES = _set("panda franka iiwa kuka sawyer baxter kinova jaco xarm yumi tiago talos anymal rizon")
"""Robots whose links are called after them: iiwa_link_4."""

ROBOTS = frozenset({"robot", "mobile robot", "robot part"})
"""Nouns of the table whose parts are called after them, as in "robot0_wrist"."""

WHOLE_ROBOT = (TOOL_WORDS | MODIFIERS | COLOURS) - {"link", "joint", "bone"}
"""Words after a robot's name that do not name a part of it."""

SHELLS = frozenset({"wall", "brick wall", "concrete wall", "dungeon wall", "tile"})
OPENINGS = frozenset({"window", "door", "doorway", "arch", "gate", "window frame"})
"""Openings that building kits use to name a piece of wall: "wall_window_closed" is a wall."""

PREPOSITIONS = _set("""
    of with on in for at by from under near without beside behind inside over against
    mit ohne auf unter neben hinter ueber zwischen am im met voor avec sans pour con sin para senza per
""")
"""The noun before one of these is the object: a bottle of wine, a table with a vase, ein Stuhl mit Lehne."""

_IRREGULAR = {
    "shelves": "shelf",
    "bookshelves": "bookshelf",
    "knives": "knife",
    "leaves": "leaf",
    "loaves": "loaf",
    "mice": "mouse",
    "men": "man",
    "women": "woman",
    "feet": "foot",
    "teeth": "tooth",
    "scarves": "scarf",
    "halves": "half",
    "dice": "die",
    "geese": "goose",
}


def forms(word: str) -> Iterator[str]:
    """Yield the word, then its possible singular forms, most likely first."""
    yield word
    if word in _IRREGULAR:
        yield _IRREGULAR[word]
    elif len(word) > 2 and word.endswith("s") and not word.endswith(("ss", "us", "is")):
        if word.endswith("ies"):
            yield word[:-3] + "y"
        yield word[:-1]
        if word.endswith(("ses", "xes", "zes", "ches", "shes", "oes")):  # boxes, but "panes" is no plural of "pan"
            yield word[:-2]
