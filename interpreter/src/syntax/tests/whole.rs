//! A whole program, block by block.

use super::accepted;

/// The program of the language reference that uses most of the words.
const PROGRAM: &str = "\
; square with a rounded and a sharp corner, run three times with growing feed
%L SIDE                         ; P20 = length, P21 = direction of travel in degrees
N10 G91 G01 X[P20*COS[P21]] Y[P20*SIN[P21]]
N20 G90
N30 M17

%SQUARES
#VAR
#ENDVAR
N100 G71 G90 G17 G53
N110 #SLOPE [TYPE=TRAPEZ]
N120 G131=80 G133=120
N130 G00 X0 Y0 Z5
N140 G135                       (feedforward on)
N150 G136 X90 Y90               (weights, Z stays at 100)
N160 #VIB GUARD ON [MODE=2 FREQ=40 DAMPING=0.1 AX_DEV=0.02]
N170 $FOR P1 = 1, V.P.RUNS, 1
N180   G01 Z0 F500
N190   F[1000*P1]
N200   P20=V.L.LEN P21=90
N210   LL SIDE
N220   #CONTOUR MODE ON [DEV PATH_DEV=0.1]
N230   P21=0
N240   LL SIDE
N250   #CONTOUR MODE OFF
N260   G60 X20 Y0               ; sharp corner, exact stop
N270   G02 X0 Y0 R15            ; back on an arc
N280   #MSG [\"run %d of %d, F = %f\", P1, V.P.RUNS, V.G.FEEDRATE]
N290   $IF P1 == 2
N300     #VIB GUARD OFF
N310     G04 0.1
N320   $ENDIF
N330 $ENDFOR
N340 G137
N350 #FLUSH WAIT
N360 G00 Z5
N370 M30
";

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
    for line in PROGRAM.lines().chain(shapes.lines()) {
        accepted(line);
    }
}
