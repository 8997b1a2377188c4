//! Path, axes, drives and compensation while they move: the vendor's numbers from 50000 to 99999.

/// Passes these rows, appended to the ones received, to the next macro of the list.
macro_rules! motion {
    ([$next:ident $($more:ident)*] $($rows:tt)*) => {
        $next! { [$($more)*] $($rows)*
    ProbeActuated = Vendor 50052: Error FeedHold 6 1, "probe actuated before the measuring run", hint "clear the probe first: the input `probe` is 1 at the start of the run";
    NoMeasuringAxis = Vendor 50059: Error FeedHold 6 1, "axis does not take part in measuring runs", cause "kenngr.messachse 0", hint "set kenngr.messachse to 1", parameter "P-AXIS-00118";
    MeasuringAxes = Vendor 50061: Error FeedHold 6 1, "more axes in a measuring run than its type allows", cause "type 2 has one axis, type 4 the three main axes", hint "select another type with #MEAS MODE [1]", parameter "P-CHAN-00057";
    SpeedError = Vendor 50118: Error FeedHold 6 0, "axis speed above the limit", cause "> vb_max·(1+P-AXIS-00440/1000), default +9 %", hint "lower the feed; if a filter overshoots, use CRIT_DAMPING or BESSEL, which hardly overshoot";
    SpeedWarning = Vendor 50119: Warning None 1 0, "axis speed above the warning level", cause "P-AXIS-00439, +5 %", hint "lower the feed; if a filter overshoots, use CRIT_DAMPING or BESSEL, which hardly overshoot";
    DynamicsLimited = Vendor 50130: Warning None 1 0, "dynamics limited", cause "weights G130-G133, G231, G233 beyond the limit", hint "lower the weight, or raise what the axis list allows (P-AXIS-00008 for accelerations)";
    CuttingSpeedZero = Vendor 50182: Error ProgramAbort 6 1, "cutting speed is 0", cause "G96 S0", hint "S is the cutting speed in m/min under G96";
    AccelerationCurve = Vendor 50254: Error AllStop 7 2, "unknown acceleration curve of a spindle", cause "beschl_kennlinie.typ 7", hint "write 0 (none), 1 (hyperbola), 2 (polynomial) or 3 (asynchronous drive)", parameter "P-AXIS-00202";
    MovedWithoutBanding = Vendor 50263: Error FeedHold 6 1, "main axis moves but does not take part in edge banding", cause "kenngr.kasto_achse 0", hint "set kenngr.kasto_achse to 1", parameter "P-AXIS-00098";
    NoBandingAxis = Vendor 50398: Error FeedHold 6 1, "no axis for edge banding", cause "kenngr.kasto_achse is 0 for all main axes", hint "set kenngr.kasto_achse to 1 for the axes of the plane", parameter "P-AXIS-00098";
    OscillationLimited = Vendor 50487: Warning None 1 0, "oscillation slower than programmed", cause "FREQ, TIME or FEED demands more than the velocity and acceleration of the axis allow", hint "lower FREQ or FEED, or bring the reversal positions closer together", parameter "P-AXIS-00212";
    SpindleStandsInThread = Vendor 50499: Error AllStop 6 0, "spindle speed is 0 with G33", cause "G33 before M3 and S", hint "write S1000 M3 before it";
    OscillationFeed = Vendor 50593: Error AbruptStop 6 1, "oscillation without a feed", cause "X[OSC ON ..] with FEED=0, or without FEED, FREQ and TIME", hint "write a feed: X[OSC ON 1ST_POS=-10 2ND_POS=10 FEED=1000]";
    BandingPath = Vendor 50655: Error FeedHold 6 1, "remaining path too short for the travel after the edge banding signal", cause "the block ends earlier, or the path is too fast to stop that soon", hint "lengthen the block, lower F, or raise V.G.RW", parameter "P-CHAN-00030";
    FilterTime = Vendor 50663: Error JobAbort 7 0, "filter time constant not allowed", cause "P-AXIS-00357: PT1 and PT2 at least one cycle, delay below 6 cycles", hint "raise or lower filter[i].time_constant (P-AXIS-00357)";
    AreaPoints = Vendor 50786: Error ProgramAbort 6 1, "too many points in a control area", hint "a polygon has 20 blocks at most";
    GuardNotRealisable = Vendor 50820: Error FeedHold 6 0, "frequency and damping not realisable by the Vibration Guard", cause "frequency too high or damping too large for T", hint "use a smaller cycle, less damping or a higher frequency (the manual's advice); kontur tune proposes both";
    FilterTimeBelowCycle = Vendor 50910: Warning None 1 0, "order_time/time_constant below the cycle time", hint "the filter uses at least one cycle: raise the time, or write ORDER";
    FilterOrderTooHigh = Vendor 50911: Warning None 1 0, "filter order too high", hint "lower the order";
    FilterWithoutOrder = Vendor 50989: Warning ProgramAbort 3 0, "FIR filter without order", cause "#FILTER ON, P-AXIS-00587 = 0", hint "write ORDER or ORDER_TIME, or P-AXIS-00587 in the axis list";
    FlushInOptional = Vendor 51081: Error ProgramAbort 6 1, "#FLUSH WAIT in a part of the program that may be skipped", cause "#FLUSH WAIT between #OPTIONAL EXECUTION ON and OFF", hint "write it before ON or after OFF";
    SpindleSpeedError = Vendor 60101: Error AllStop 6 0, "spindle speed limit exceeded", cause "+9 %", hint "lower the speed; if a filter overshoots, use CRIT_DAMPING or BESSEL, which hardly overshoot";
    SpindleSpeedWarning = Vendor 60102: Warning None 1 0, "spindle speed above the warning level", cause "+5 %", hint "lower the speed; if a filter overshoots, use CRIT_DAMPING or BESSEL, which hardly overshoot";
    SpindleAtRestAtFeed = Vendor 60131: Error AllStop 6 0, "feed per revolution while the spindle is at rest", cause "G95 before M3 and S", hint "start the spindle first: S1000 M3";
    SpindleSpeedZeroAtFeed = Vendor 60132: Error AllStop 6 0, "spindle speed is 0 while feed per revolution is active", hint "program the speed first: S1000 M3";
    SpindleStoppedInThread = Vendor 60154: Error AllStop 6 0, "G33 while the spindle is at rest", cause "S1000 and G33 without M3", hint "write M3 or M4 before it";
    SpindleSlopeType = Vendor 60226: Warning None 1 0, "invalid slope type of a spindle", cause "P-AXIS-00270", hint "write 0 to 3 in getriebe[i].slope_type (P-AXIS-00270)";
    GearWhileMoving = Vendor 60285: Error ProgramAbort 6 6, "gear stage changed while the spindle is moving", cause "G112 S2 after M3", hint "write M5 in a block before G112";
    ToolLimitsInvalid = Vendor 60296: Error AllStop 6 0, "dynamic data of the tool are invalid as limits of its spindle", cause "P-TOOL-00014 or P-TOOL-00015 is 0", hint "set wz[i].vb_max and wz[i].a_max above 0, or wz[i].log_ax_nr_spdl to 0", parameter "P-TOOL-00014";
    ThreadOffsetRange = Vendor 60303: Error AllStop 6 1, "offset angle of a thread outside the modulo range of the spindle", cause "G33 Z48 K1.5 S.OFFSET=500", hint "write an angle from 0 to 360", parameter "P-AXIS-00126";
    SpindleFilterTime = Vendor 60311: Error JobAbort 7 0, "filter time constant of a spindle not allowed", cause "as 50663", hint "raise or lower filter[i].time_constant (P-AXIS-00357)";
    ToolSpeed = Vendor 60312: Error ProgramAbort 6 0, "spindle speed outside the range of the tool", cause "P-AXIS-00474 = 1, S outside P-TOOL-00013 to P-TOOL-00014", hint "program another speed, or change the range in the tool list", parameter "P-AXIS-00474";
    ToolLeastSpeed = Vendor 60332: Warning None 1 1, "minimum speed of the tool outside its range, corrected", cause "P-TOOL-00013 negative or above P-TOOL-00014", hint "write 0 to wz[i].vb_max in wz[i].vb_min", parameter "P-TOOL-00013";
    FollowingError = Vendor 70020: Error OpenLoopStop 6 11, "following error too large", cause "limits P-AXIS-00167 to 00172, P-AXIS-00191", hint "raise slep_max, use feedforward (G135), or lower the feed", parameter "P-AXIS-00172";
    ActualAbovePositiveLimit = Vendor 70021: Error ControlledStop 6 11, "actual position beyond the positive software limit", cause "P-AXIS-00178 and P-AXIS-00179, overshoot of the axis", hint "lower the gain kv or the feedforward, move the target away from the limit, or raise swe_toleranz (P-AXIS-00179)", parameter "P-AXIS-00179";
    ActualBelowNegativeLimit = Vendor 70022: Error ControlledStop 6 11, "actual position beyond the negative software limit", cause "P-AXIS-00177 and P-AXIS-00179, overshoot of the axis", hint "lower the gain kv or the feedforward, move the target away from the limit, or raise swe_toleranz (P-AXIS-00179)", parameter "P-AXIS-00179";
    SettlingTimeout = Vendor 70082: Error AbruptStop 6 11, "exact-stop window not reached in time", cause "window P-AXIS-00236, time P-AXIS-00532", hint "raise position_settling_time (P-AXIS-00532), the window or the gain kv", parameter "P-AXIS-00236", note "recommended: limit 10..200 ms, window at least three times the lag at standstill";
    GantryMasterUnmarked = Vendor 70124: Warning None 7 0, "gantry master not marked as such in its axis list", cause "kenngr.achs_mode without the bit 0x10000", hint "add 0x10000 to kenngr.achs_mode of the master", parameter "P-AXIS-00015";
    GantryModulo = Vendor 70202: Warning None 7 0, "modulo settings of gantry master and slave differ, the slave uses those of the master", cause "P-AXIS-00018, or the bit 0x4 of P-AXIS-00015, differs", hint "write the same kenngr.achs_typ and the same bit 0x4 of kenngr.achs_mode in both lists", parameter "P-AXIS-00015";
    AxisWithoutPositionControl = Vendor 70345: Error AbruptStop 7 11, "axis without position control that is not a spindle", cause "P-AXIS-00320", hint "set antr.operation_mode to CNC_POSITION_CONTROL or DRIVE_DEFAULT for path axes";
    AccelerationDelay = Vendor 70348: Warning None 1 11, "acceleration (or jerk) feedforward delay too large, set to 0", cause "P-AXIS-00390, P-AXIS-00547", hint "write a delay below 6 cycles (P-AXIS-00390, P-AXIS-00547)";
    VelocityDelay = Vendor 70349: Warning None 1 11, "velocity feedforward delay too large, set to 0", cause "P-AXIS-00389", hint "write a delay below 6 cycles (P-AXIS-00389)";
    NoAdditiveVelocity = Vendor 70350: Warning None 1 11, "additive velocity missing in the process data", cause "P-AXIS-00223 ADD_VEL", hint "enter S_0_0037 in antr.sercos.mdt[i].nc_ref";
    NoAdditiveTorque = Vendor 70351: Warning None 1 11, "additive torque missing in the process data", cause "P-AXIS-00223 ADD_ACC", hint "enter S_0_0080 in antr.sercos.mdt[i].nc_ref";
    ControllerSpeed = Vendor 70382: Error ControlledStop 6 11, "axis speed above the limit in the controller", cause "P-AXIS-00407 (default 100 % over vb_max; 0 = off)", hint "lower the gain kv or the feed, or raise lr_param.dyn_monitoring_v_err; 0 switches the monitor off", parameter "P-AXIS-00407";
    IpcGantrySlave = Vendor 70600: Warning None 7 11, "Improved Position Control enabled for a gantry slave", cause "P-AXIS-00758", hint "write the parameters in the list of the master", note "set Improved Position Control in the gantry master; its slaves use the same values";
    IpcChangedMoving = Vendor 70601: Error ControlledStop 6 11, "parameters of Improved Position Control changed while moving", hint "change them at standstill";
    IpcNumerator = Vendor 70603: Warning None 1 11, "weight numerator of Improved Position Control not greater than 0", cause "P-AXIS-00754", hint "write a value above 0 (P-AXIS-00754)";
    IpcDenominator = Vendor 70604: Warning None 1 11, "weight denominator of Improved Position Control not greater than 0", cause "P-AXIS-00755", hint "write a value above 0 (P-AXIS-00755)";
    SimulationDamping = Vendor 80044: Warning None 1 11, "damping of the simulated drive ≥ 1", cause "P-AXIS-00051 is at least P-AXIS-00050", hint "write daempfung_z below daempfung_n (P-AXIS-00051, P-AXIS-00050)";
    CompensationInArc = Vendor 90008: Error ProgramAbort 6 1, "tool radius compensation selected in a circular block", cause "G41 and G42 must be followed by a linear block", hint "write a linear block after G41 and G42";
    ToolTooLarge = Vendor 90017: Error ProgramAbort 6 1, "tool radius not less than the radius of an arc of the contour", hint "use a smaller tool, or a larger contour radius";
    LineRunsBack = Vendor 90019: Error ProgramAbort 6 1, "tool radius compensation: the tool would move backwards along a line", cause "line at an inside corner, shorter than the part that the corner removes", hint "use a smaller tool, or open the contour; intersections are only searched between adjacent blocks";
    ToolBetweenArcs = Vendor 90031: Error ProgramAbort 6 1, "tool radius compensation: tool too large for the corner between two arcs", hint "use a smaller tool, or larger contour radii";
    ArcRunsBack = Vendor 90038: Error ProgramAbort 6 1, "tool radius compensation: the tool would move once around an arc", cause "arc at an inside corner, shorter than the part that the corner removes", hint "use a smaller tool, or open the contour; intersections are only searched between adjacent blocks";
    RadiusChangeInArc = Vendor 90047: Error ProgramAbort 6 1, "tool radius changes before an arc", cause "D or V.G.WZ_AKT.R under G41, then G02", hint "write a line before the arc";
    FlushAfterCompensation = Vendor 90050: Error ProgramAbort 3 1, "channel flush between G40 and the motion that leads away from the contour", cause "G40, then #FLUSH", hint "write a straight motion with G40 or after it";
    InsideCornerTooNear = Vendor 90123: Error ProgramAbort 6 1, "contour of G238 nearer to its selection point than the tool radius", hint "start at another corner, or use a smaller tool";
    InsideCornerRadius = Vendor 90127: Error ProgramAbort 3 1, "tool radius changed within the contour of G238", hint "change the tool before G41 or after G40";
    CompensatedOutsideFormat = Vendor 90134: Error ProgramAbort 6 1, "compensated position outside the data format", cause "lines of a contour that meet at a very acute angle", hint "positions reach up to 214748.3647 mm or deg; insert a short block at the corner";
    WearSelectedInArc = Vendor 90183: Error ProgramAbort 3 1, "tool radius compensation starting with an arc during online tool compensation", cause "#OTC ON, then G41 with an arc (G237)", hint "start with a line, or write #OTC OFF before it";
    SpaceArcAfterCompensation = Vendor 90193: Error ProgramAbort 3 1, "arc in space after G40", cause "G40, then G303", hint "write a straight motion with G40 or after it";
        }
    };
}
