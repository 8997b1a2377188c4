; run: exit 0
; page 15556923531 least radius of the tangential feed, older form (#SET TANGFEED RMIN)
; warning K-0111 at 8:20
; passes X30 Y15
; passes X35 Y30
N10 V.G.WZR=5
N20 #SET TANGFEED RMIN [3]
N30 G41 G01 X0 Y20 G11 F600
N40 X20 Y20
N50 G03 X40 R10
N60 G01 Y40
N70 G40 G10 X60
N80 M30
