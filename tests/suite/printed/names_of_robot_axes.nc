; run --identity-trafo: exit 0
; page - program of a user: welding robot with transformations (ORNL Slicer, Arc Specialties)
; warning K-0111 at 12:5
; warning K-0111 at 13:5
; warning K-0111 at 15:5
; warning K-0111 at 17:5
; passes X8.48528 Y8.48528
; end X0 Y12 Z1
N10 G90
N20 #TRAFO OFF
N30 #FLUSH WAIT
N40 #KIN ID [9]
N50 V.G.KIN[9].PROGRAMMING_MODE = -1
N60 V.G.KIN[9].RTCP = 0
N70 #ORI MODE [ANGLE]
N80 V.G.WZ_AKT.L = 0
N90 #TRAFO ON
N100 #FLUSH WAIT
N110 #CHANNEL INIT [CMDPOS]
N120 G161
N130 G01 X=12.0000 Y=0.0000 Z=1.5000 F6000.0000
N140 G03 X=0.0000 Y=12.0000 Z=1.0000 I=0.0000 J=0.0000 F6000.0000
N150 G164
N160 M02
