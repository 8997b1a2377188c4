//! Parameters of axis and channel lists: the vendor's numbers from 100000 on.

/// Passes these rows, appended to the ones received, to the next macro of the list.
macro_rules! lists {
    ([$next:ident $($more:ident)*] $($rows:tt)*) => {
        $next! { [$($more)*] $($rows)*
    DeadTime = Vendor 110040: Warning None 1 2, "dead time of the simulated drive above the maximum, limited to 5", cause "P-AXIS-00194", hint "write a value from 0 to 5 cycles";
    AxisNumberZero = Vendor 110076: Error JobAbort 7 2, "logical axis number is 0", cause "P-AXIS-00016", hint "write 1 or more in kopf.achs_nr";
    AxisSpeedZero = Vendor 110079: Warning None 1 2, "maximum axis speed is 0, default used", cause "P-AXIS-00212", hint "write the maximum speed of the axis";
    ShortestRampTime = Vendor 110083: Warning None 1 2, "shortest ramp time below its limit, limited", cause "P-AXIS-00201";
    ResolutionPath = Vendor 110086: Warning None 1 2, "encoder resolution (path) is 0, set to 1", cause "P-AXIS-00233", hint "write 1 or more";
    WindowZero = Vendor 110087: Warning None 1 2, "position window is 0, default used", hint "write the exact-stop window in 0.1 um", parameter "P-AXIS-00236";
    FeedAccelerationZero = Vendor 110100: Warning None 1 2, "acceleration is 0, default used", hint "write the feed acceleration in mm/s2", parameter "P-AXIS-00001";
    FeedDecelerationZero = Vendor 110102: Warning None 1 2, "deceleration is 0, default used", hint "write the feed deceleration in mm/s2", parameter "P-AXIS-00002";
    SoftwareLimitRange = Vendor 110110: Warning None 1 2, "software limits leave no travel, corrected", cause "P-AXIS-00177, P-AXIS-00178", hint "write kenngr.swe_neg below kenngr.swe_pos";
    OverrideRange = Vendor 110111: Warning None 1 2, "maximum override below the minimum override, limited", cause "P-AXIS-00109", hint "write 1 to 2000 (0.1 %)";
    GearStageZero = Vendor 110115: Warning None 1 1, "gear stage 0 at start-up, default used", cause "kenngr.getriebe_stufe 0", hint "write 1 or more", parameter "P-AXIS-00079";
    FeedforwardNumerator = Vendor 110122: Warning None 1 2, "weight numerator of the velocity feedforward is 0, set to 1", cause "P-AXIS-00514; printed for P-AXIS-00228 too", hint "write 1 or more", note "the feedforward manual allows a numerator of 0, so P-AXIS-00228 = 0 is a valid weight here; P-AXIS-00514 = 0 raises it";
    FeedforwardDenominator = Vendor 110123: Warning None 1 2, "weight denominator of the feedforward is 0, set to 1", cause "P-AXIS-00229, P-AXIS-00515", hint "write 1 or more; a numerator of 0 gives the weight 0";
    GainZero = Vendor 110150: Warning None 1 2, "gain of the position controller is 0, default used", cause "P-AXIS-00099", hint "write 1 or more, in 0.01/s";
    FilterType = Vendor 110239: Error JobAbort 7 2, "unknown filter type, filter off", cause "P-AXIS-00204", hint "use LOWPASS, HIGHPASS, BANDPASS, BANDSTOP, ALLPASS, PT1, TIME_DELAY, PT2 or HSC_MEAN";
    TimeBaseUnknown = Vendor 110268: Error JobAbort 7 2, "unknown time base of the speed scaling", cause "antr.v_time_base 9", hint "write 0 (per minute), 1 (per second) or 2 (per sampling interval)", parameter "P-AXIS-00207";
    SpeedScaleDenominator = Vendor 110270: Error JobAbort 7 2, "denominator of the speed scaling is 0", cause "antr.v_reso_denom 0", hint "write 1 or more", parameter "P-AXIS-00205";
    GeometricRampTime = Vendor 110276: Warning None 1 2, "geometric ramp time below the shortest ramp time, limited", hint "raise P-AXIS-00199, or lower P-AXIS-00201", parameter "P-AXIS-00199";
    SpindleWithoutType = Vendor 110304: Error ProgramAbort 7 2, "spindle in the channel list whose axis list does not describe a spindle", hint "kenngr.achs_typ ACHSTYP_SPINDEL makes an axis a spindle", parameter "P-AXIS-00018";
    GantryMasterOfMaster = Vendor 110342: Error JobAbort 7 2, "gantry master that is itself a gantry slave", cause "kenngr.achs_mode with the bit 0x10000 beside kenngr.gantry_ax_nr", hint "set kenngr.gantry_ax_nr of the master to 0", parameter "P-AXIS-00070";
    SpindleMode = Vendor 110352: Warning None 1 2, "axis mode of a spindle is not modulo, modulo used", cause "kenngr.achs_mode 1 in the list of a spindle", hint "write 4 (modulo) for spindles", parameter "P-AXIS-00015";
    AxisMode = Vendor 110353: Warning None 1 2, "unknown axis mode, corrected", cause "kenngr.achs_mode 8", hint "write 1 (linear), 2 (optimised positioning) or 4 (modulo)", parameter "P-AXIS-00015";
    FilterFrequencyTooLow = Vendor 110361: Warning None 1 2, "filter frequency below the lowest possible frequency, lowest frequency used", cause "P-AXIS-00067", hint "write a frequency above it and below half the sampling rate";
    AccelerationDenominator = Vendor 110381: Warning None 1 2, "denominator of the acceleration feedforward is 0, set to 1", cause "P-AXIS-00226", hint "write 1 or more; a numerator of 0 switches this feedforward off";
    ResolutionIncrements = Vendor 110386: Warning None 1 2, "encoder resolution (increments) is 0, set to 1", cause "P-AXIS-00234", hint "write 1 or more";
    WeightedRampFloor = Vendor 110406: Warning None 1 2, "lower limit of weighted ramp times below the shortest ramp time, corrected", cause "P-AXIS-00293", hint "write 0, or a time between tr_min and the ramp times";
    TorqueScaleDenominator = Vendor 110465: Warning None 1 2, "denominator of the torque scaling is 0, no torque output", cause "P-AXIS-00326", hint "write the value at which the motor gives its nominal torque";
    FeedConstantDenominator = Vendor 110472: Error JobAbort 7 2, "denominator of the feed constant is 0", cause "P-AXIS-00363", hint "write the revolutions of the feed constant, 1 or more";
    JerkDenominator = Vendor 110473: Warning None 1 2, "denominator of the jerk feedforward is 0, set to 100", cause "P-AXIS-00338", hint "write 1 or more";
    SecondHsc = Vendor 110500: Warning None 1 2, "more than one HSC filter on an axis, the surplus one is off", cause "P-AXIS-00153", hint "keep only one HSC filter";
    HscNotFirst = Vendor 110501: Warning None 1 2, "HSC filter must be filter[0], filter off", cause "P-AXIS-00153", hint "configure it as filter[0]";
    DeadBand = Vendor 110528: Warning None 1 2, "dead band of the position controller above the window, limited", cause "P-AXIS-00395, P-AXIS-00236", hint "write a dead band up to getriebe[i].window";
    CAxisWithoutModulo = Vendor 110565: Warning None 1 2, "C axis is not a modulo axis, corrected", cause "kenngr.achs_mode 0x200", hint "write 0x204", parameter "P-AXIS-00015";
    GearRatio = Vendor 110579: Warning None 1 2, "output revolutions of the gear ratio are 0, set to 1", cause "P-AXIS-00512", hint "write 1 or more", note "raised for P-AXIS-00512 = 0, as stated in two manuals; one page of the diagnosis manual prints 110580";
    WithoutDelayNeedsVelocityOnly = Vendor 110624: Warning None 1 2, "feedforward without delay combined with acceleration or jerk feedforward, these are switched off", cause "P-AXIS-00566, P-AXIS-00223", hint "allow velocity feedforward only (P-AXIS-00223 VEL), or drop feedforward_without_delay";
    WeightMode = Vendor 120020: Error ProgramAbort 6 0, "unknown mode of the ramp-time weights", cause "#SET SLOPE PROFIL [1,7,0]", hint "write 0 (all) or 1 to 4 (one of the ramp times)";
    FirstStageZero = Vendor 120028: Warning None 1 2, "acceleration of stage 1 weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00011";
    SecondStageZero = Vendor 120030: Warning None 1 2, "acceleration of stage 2 weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00012";
    AccelerationZero = Vendor 120032: Warning None 1 2, "acceleration weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00001";
    DecelerationTooLarge = Vendor 120033: Warning None 1 2, "weighted deceleration above its limit, limited", cause "G131=1000, G130 X1000", hint "lower the weight", parameter "P-AXIS-00002";
    DecelerationZero = Vendor 120034: Warning None 1 2, "deceleration weighted to 0, limited to the minimum", cause "G131=0, G130 X0", hint "write a weight above 0", parameter "P-AXIS-00002";
    DecelerationRampUp = Vendor 120037: Warning None 1 2, "weighted ramp time of a growing deceleration below the minimum, limited", cause "G133=1, G132 X1", hint "raise the weight, or lower the minimum ramp time of the axis list (P-AXIS-00293)", parameter "P-AXIS-00198";
    DecelerationRampDown = Vendor 120038: Warning None 1 2, "weighted ramp time of a falling deceleration below the minimum, limited", cause "G133=1, G132 X1", hint "raise the weight, or lower the minimum ramp time of the axis list (P-AXIS-00293)", parameter "P-AXIS-00197";
    SplineTransition = Vendor 120097: Error ProgramAbort 6 0, "unknown transition type of an Akima spline", cause "#SET ASPLINE MODE [9, 1]", hint "write 1 (automatic), 2 (tangential) or 3 (by a vector)";
    SplineEndTangent = Vendor 120100: Error ProgramAbort 6 0, "end tangent of an Akima spline has no direction", cause "#AKIMA ENDVECTOR X0 Y0", hint "write a component other than 0";
    FlushInSpline = Vendor 120102: Error ProgramAbort 3 0, "channel flush while a spline is active", cause "#FLUSH WAIT after #HSC ON [BSPLINE]", hint "write #HSC OFF before it";
    SplineWithoutMotion = Vendor 120112: Error ProgramAbort 6 0, "no motion before a spline with a tangential start", cause "#AKIMA TRANS [START=TANGENTIAL] before the first motion", hint "write a motion before G151, or START=AUTO";
    PathDevTooSmall = Vendor 120129: Error ProgramAbort 3 0, "PATH_DEV below the minimum", hint "write 0.0001 mm or more";
    CornerDistanceTooSmall = Vendor 120131: Error ProgramAbort 3 0, "corner distance below the minimum", hint "write 0.0001 mm or more";
    CuttingSpeedNegative = Vendor 120167: Error ProgramAbort 6 1, "cutting speed not greater than 0", cause "G96 S-5", hint "S is the cutting speed in m/min under G96";
    CuttingSpeedMax = Vendor 120169: Error ProgramAbort 3 1, "maximum spindle speed of G196 not greater than 0", hint "write the maximum speed in S: G196 S2500";
    PitchAxisMissing = Vendor 120173: Error ProgramAbort 6 1, "pitch of a thread along a main axis that the channel does not have", cause "#PUT AX [Z], then G33 X10 K1", hint "I, J and K are pitches along the first, second and third main axis";
    SlopeWeighting = Vendor 120178: Error ProgramAbort 6 0, "unknown ramp-time weighting mode", cause "P-CHAN-00073", hint "write 0 (all) or 1 to 4 (one of the ramp times)", parameter "P-CHAN-00073";
    SplineWithoutMainAxis = Vendor 120180: Error ProgramAbort 6 0, "spline point without motion of a main axis", cause "G151 with tracking axes alone", hint "move tracking axes together with main axes";
    ContouringAtEnd = Vendor 120206: Warning None 1 0, "program ends with contouring active", hint "write G260 or #CONTOUR MODE OFF before the end";
    ContouringNotPossible = Vendor 120207: Error ProgramAbort 3 0, "contouring not possible (measurement, feed group, corner)", hint "switch contouring off with G260 at this corner";
    BlockTooShort = Vendor 120216: Warning None 1 0, "block too short for contouring", hint "lower PATH_DEV or the corner distances, or merge the short blocks";
    SplineWithContouring = Vendor 120255: Error ProgramAbort 3 0, "spline combined with contouring or #HSC", cause "G151 under G261", hint "write G260 or #HSC OFF before G151";
    CouplingWithContouring = Vendor 120333: Error ProgramAbort 3 0, "axis coupling switched while contouring is active", cause "#ENABLE AX LINK under G261", hint "write G260 before it";
    SplineInSurface = Vendor 120370: Error ProgramAbort 3 0, "spline selected while free-form surface mode is active", cause "G151 after #HSC ON [BSPLINE]", hint "write #HSC OFF before G151";
    HscModeWhileOn = Vendor 120378: Error ProgramAbort 6 1, "mode of #HSC changed while #HSC is on", cause "#HSC ON [OPMODE=1], then #HSC [BSPLINE]", hint "write #HSC OFF before it";
    FeedGroupOfArc = Vendor 120462: Warning None 1 1, "feed group does not fit an arc", cause "#FGROUP [X] and G02 in the plane X, Y", hint "name all axes of the arc in #FGROUP, or none of the main axes";
    NoOscillation = Vendor 120470: Error ProgramAbort 6 1, "oscillation without travel", cause "X[OSC ON 1ST_POS=50 2ND_POS=50 ..]", hint "write different reversal positions 1ST_POS and 2ND_POS";
    AreaOverlaps = Vendor 120477: Error ProgramAbort 6 1, "sides of a control area cross each other", hint "write the corners in order around the area";
    OutsideWorkspace = Vendor 120484: Error ProgramAbort 6 1, "point outside a workspace", cause "start or end of a motion, or of the tool at #CONTROL AREA ON", hint "write #CONTROL AREA OFF [ID=..] before it, or another target";
    ContouringFeedGroup = Vendor 120566: Error ProgramAbort 6 1, "contouring while the feed axes are not the main axes", cause "G261 with #FGROUP [X,Y]", hint "contouring needs the default feed axes: write #FGROUP, or G260", parameter "P-CHAN-00011";
    ContouringGroupChanged = Vendor 120567: Error ProgramAbort 6 1, "feed axes changed after a contoured block", cause "G61, then #FGROUP", hint "switch contouring off before the feed group changes";
    MeasuringWithContouring = Vendor 120652: Error ProgramAbort 6 0, "measuring run while contouring is active", cause "G261 before G100", hint "write G260 before the measuring run";
    AreaOfArcs = Vendor 120691: Error ProgramAbort 6 1, "motion not allowed in the contour of a control area", cause "G02 in a control area POLY", hint "use straight lines only for POLY, one full circle for CIRC";
    IndependentInSpline = Vendor 120697: Error ProgramAbort 6 1, "independent axis within a spline", cause "#HSC ON [BSPLINE] or G151, then X[INDP_ASYN ..]", hint "end the spline first, or move the axis with the path";
    SoftContouringActive = Vendor 120698: Error ProgramAbort 6 1, "contouring mode changed to or from DIST_SOFT while contouring is active", cause "#CONTOUR MODE [DIST_SOFT] under G261 of another mode", hint "write G260 before #CONTOUR MODE and G261 after it";
    AreaHeightInBase = Vendor 120734: Error ProgramAbort 6 1, "axis of EXCUR_AX in the base of its control area", cause "EXCUR_AX=X with a contour in X and Y", hint "choose a third axis that is not an axis of the contour";
    AreaOneAxis = Vendor 120736: Error ProgramAbort 6 1, "control area with one axis in its base", cause "X2 without Y2", hint "write the contour in two axes";
    AreaAxisMissing = Vendor 120740: Error ProgramAbort 6 1, "axis of a control area not in the channel", cause "#PUT AX [Y] before #CONTROL AREA ON", hint "call the axis back with #CALL AX";
    AreaAxisAlone = Vendor 120742: Error ProgramAbort 6 1, "axis of a control area moved independently", cause "X[INDP_ASYN ..] while a control area of X is active", hint "write #CONTROL AREA OFF [ID=..] before it";
    AreaCircleAxis = Vendor 120743: Error ProgramAbort 6 1, "axis not allowed in the circle of a control area", cause "G02 with an axis that is not a main axis", hint "write the base of CIRC in main axes";
    TimeInSpline = Vendor 120847: Warning None 1 1, "G93 in a B-spline, F counts as under G94", cause "#HSC ON [BSPLINE], then G93", hint "write G94 with F in mm/min before #HSC";
    ListKeyUnknown = Vendor 1001119: Warning None 1 2, "unknown element in a parameter list", cause "element ignored", hint "kontur explain KEY describes a key; --strict refuses unknown ones";
    ListNumber = Vendor 1001138: Warning None 1 2, "invalid number format or value outside the type's range", cause "value limited to min/max, or 0 if not a number; loading continues", hint "write numbers as 10, -10, 1.5 or 0x101";
        }
    };
}
