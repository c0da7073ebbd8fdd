"""Which cards and options the conversion to a scene reads; all others are listed."""

# Card -> options that are read.
READ = {
    "NODE": "NSET SYSTEM", "SYSTEM": "", "ELEMENT": "TYPE ELSET", "NSET": "NSET GENERATE INSTANCE ELSET", "ELSET": "ELSET GENERATE INSTANCE",
    "SURFACE": "NAME TYPE COMBINE", "MATERIAL": "NAME", "ELASTIC": "TYPE", "EXPANSION": "TYPE ZERO", "DENSITY": "",
    "SOLIDSECTION": "ELSET MATERIAL ORIENTATION", "ORIENTATION": "NAME SYSTEM DEFINITION",
    "SURFACEINTERACTION": "NAME", "FRICTION": "", "SURFACEBEHAVIOR": "PRESSURE-OVERCLOSURE NOSEPARATION",
    "CONTACTPAIR": "INTERACTION ADJUST", "TIE": "NAME ADJUST POSITIONTOLERANCE", "CLEARANCE": "MASTER SLAVE VALUE",
    "BOUNDARY": "OP AMPLITUDE FIXED TYPE", "CLOAD": "OP AMPLITUDE", "DLOAD": "OP AMPLITUDE", "DSLOAD": "OP AMPLITUDE",
    "TEMPERATURE": "OP AMPLITUDE", "INITIALCONDITIONS": "TYPE", "AMPLITUDE": "NAME TIME DEFINITION VALUE", "STEP": "AMPLITUDE", "STATIC": "",
    "PRE-TENSIONSECTION": "SURFACE NODE", "COUPLING": "CONSTRAINTNAME REFNODE SURFACE", "KINEMATIC": "", "DISTRIBUTING": "",
    "KINEMATICCOUPLING": "REFNODE", "RIGIDBODY": "NSET REFNODE ROTNODE TIENSET PINNSET ELSET", "HEADING": "",
    "TRANSFORM": "NSET TYPE", "FOUNDATION": ""}
# Card -> options without influence on the answer of a scene.
WITHOUT_EFFECT = {
    "NSET": "INTERNAL UNSORTED", "ELSET": "INTERNAL UNSORTED", "SURFACE": "INTERNAL TRIM DEFINITION", "ELASTIC": "MODULI",
    "MATERIAL": "RTOL SRATE", "SOLIDSECTION": "CONTROLS", "FRICTION": "SLIPTOLERANCE ELASTICSLIP", "CONTACTPAIR":
    "TYPE SMALLSLIDING TRACKING CPSET EXTENSIONZONE SUPPLEMENTARYCONSTRAINTS SMOOTH HCRIT GEOMETRICCORRECTION MECHANICALCONSTRAINT",
    "TIE": "TYPE NOROTATION CONSTRAINTRATIO", "SURFACEINTERACTION": "UNSYMM", "STEP": "NAME INC INCF UNSYMM EXTRAPOLATION CONVERTSDI NLGEOM",
    "STATIC": "DIRECT SOLVER STABILIZE RIKS TIMERESET TOTALTIMEATSTART", "COUPLING": "INFLUENCERADIUS ORIENTATION",
    "DISTRIBUTING": "WEIGHTINGMETHOD COUPLING CYCLICSYMMETRY", "SURFACEBEHAVIOR": "", "BOUNDARY": "REGIONTYPE", "CLOAD": "FOLLOWER",
    "DLOAD": "FOLLOWER", "DSLOAD": "FOLLOWER", "ELEMENT": "SOLIDELEMENT", "CLEARANCE": ""}
# Cards that only control the solution or its output.
ASIDE = set("NODEFILE ELFILE NODEPRINT ELPRINT CONTACTFILE CONTACTPRINT SECTIONPRINT OUTPUT NODEOUTPUT ELEMENTOUTPUT CONTACTOUTPUT ENERGYOUTPUT "
            "RESTART PREPRINT CONTROLS SOLVER MONITOR PRINT ENERGYFILE ENERGYPRINT FILEFORMAT FILEOUTPUT NODALENERGYOUTPUT CONTACTCONTROLS "
            "SECTIONCONTROLS TIMEPOINTS DIAGNOSTICS PARAMETER INTEGRATEDOUTPUT SECTIONFILE ELEMENTMATRIXOUTPUT PHYSICALCONSTANTS FILTER "
            "INTEGRATEDOUTPUTSECTION SURFACESECTION SFMSECTION NOMAP ELEMENTPRINT".split())
# Cards that another module removes from the list when it reads their parts, or that only mark a place.
MARKS = {"ENDSTEP", "REFERENCEPOINT"}
# Card -> why a scene cannot have it.
GENERAL = "contact without named pairs; write *CONTACT PAIR for the surfaces that touch"
SPRING = "a scene has springs on areas only (Elastic Support), no springs at nodes"
PLASTIC = "the materials of a scene are linear elastic"
TIED_NODES = "a scene has no equations between nodes; tie surfaces by *TIE, or use *RIGID BODY with given motions"
LIMITS = {
    **dict.fromkeys(("CONTACT", "CONTACTINCLUSIONS", "CONTACTPROPERTYASSIGNMENT", "CONTACTINITIALIZATIONDATA", "CONTACTEXCLUSIONS"), GENERAL),
    **dict.fromkeys(("SPRING", "DASHPOT", "CONNECTORSECTION", "CONNECTORBEHAVIOR", "GAP"), SPRING),
    **dict.fromkeys(("PLASTIC", "CREEP", "HYPERELASTIC", "HYPERFOAM", "VISCOELASTIC", "CYCLICHARDENING", "DRUCKERPRAGER", "DEFORMATIONPLASTICITY",
                     "MOHRCOULOMB", "CAPPLASTICITY", "CONCRETE", "USERMATERIAL", "DEPVAR", "DAMPING"), PLASTIC),
    **dict.fromkeys(("EQUATION", "MPC", "DISTRIBUTINGCOUPLING"), TIED_NODES),
    "MODELCHANGE": "a scene has the same contacts in all steps", "CHANGEFRICTION": "a scene has the same friction in all steps",
    "MASS": "a scene has no masses at nodes", "CONTACTDAMPING": "a scene has no damping",
    "CYCLICSYMMETRYMODEL": "a scene has no cyclic symmetry"}
# Card -> options with which it has another meaning; then the whole card is left out.
OTHER_MEANING = {"BOUNDARY": {"SUBMODEL", "USER", "BASENAME", "LOADCASE", "MASSFLOW"}, "CLOAD": {"SUBMODEL", "USER", "LOADCASE", "SECTOR", "OMEGA0"},
                 "DLOAD": {"USER", "LOADCASE", "SECTOR"}, "DSLOAD": {"SUBMODEL", "USER", "LOADCASE", "SECTOR"},
                 "TEMPERATURE": {"FILE", "USER", "SUBMODEL", "BSTEP"}, "TIE": {"CYCLICSYMMETRY", "MULTISCALE", "FLUIDPERIODIC"}}


def check(cards, findings):
    """Lists the cards and options that no module reads. \return cards without those that are left out completely"""
    kept = []
    for card in cards:
        other = sorted(OTHER_MEANING.get(card.keyword, set()) & {option.replace(" ", "") for option in card.options})
        if card.keyword in ASIDE:
            findings.put_aside(card.place, card.title)
        elif other:
            findings.leave(card.place, f"{card.title} with the option {other[0]}")
            continue
        elif card.keyword in READ:
            check_options(card, findings)
        elif card.keyword not in MARKS:
            why = LIMITS.get(card.keyword, "")
            findings.leave(card.place, card.title + (f": {why}" if why else ""))
        kept.append(card)
    return kept


def check_options(card, findings):
    known = set((READ[card.keyword] + " " + WITHOUT_EFFECT.get(card.keyword, "")).split())
    for option, value in card.options.items():
        if option.replace(" ", "") not in known:
            findings.leave(card.place, f"{card.title}: option {option}{'=' + value if value else ''}")
