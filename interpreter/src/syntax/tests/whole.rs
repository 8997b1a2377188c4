//! The shapes of real programs, block by block. `exec/tests/errors.rs` runs the program of the language reference.

use super::accepted;

#[test]
fn whole_programs_parse_clean() {
    // shapes of real programs: bioprinting, additive manufacturing, robots, woodworking, plain CAM output
    let shapes = "\
% job
T1
M200=800
M110=40
G803
G807[1, 0.002, 0.002]
#CONTOUR MODE ON [DEV PATH_DEV=0.08]
F10.000
G00 G55 X12.500 Y-3.250
Y-1.900
X-0.000
V.E.Printer.Material = \"gel\"
#FILE NAME[ G80=\"layer.nc\" ]
#DELETE V.S.SPEED
$IF EXIST[V.S.SPEED]==FALSE
#CHANNEL INIT [CMDPOS]
#TRAFO OFF
#KIN ID [9]
V.G.KIN[9].RTCP = 0
V.G.WZ_AKT.L = 0
#ORI MODE [ANGLE]
N10010 G02 X5 Y0 I2.5 J0 G81
% next part
G133 150
#HSC [BSPLINE PATH_DEV 0.0000 TRACK_DEV 0.0000]
#CS ON[1,2,3,0,0,90]
G1 X1=10.1234 Y12.3456 A0.0000 B90.0000 C-12.345678
(----------------)
N099 $IF V.E.Y==TRUE
G130 X90 Y90 Z90 A90 B90 C90
L CYCLE [NAME=CH_SPINDEL.NC @P3=24000]
#SET SLOPE PROFIL
V.P.S = \"n\" + REAL_TO_STR[P1]
M29
";
    for line in shapes.lines() {
        accepted(line);
    }
}
