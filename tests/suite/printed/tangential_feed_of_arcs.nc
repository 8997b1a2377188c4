; run: exit 0
; page 207065483 least radius of the tangential feed (#TANGFEED)
; warning K-0111 at 11:20
; passes X30 Y14.5
; passes X35.5 Y30
; passes X48.5 Y30
; passes X49.5 Y30
; end X0 Y0
N10 V.G.WZR=4.5 (the page has 5, the radius of the last arc)
N20 #TANGFEED [RMIN=3]
N30 G41 G01 X0 Y20 G11 F600
N40 X20 Y20
N50 G03 X40 R10
N60 G01 Y40
N70 G02 X44 R2
N80 G01 Y20
N90 #TANGFEED [RMIN=6]
N100 G03 X54 R5
N110 G01 Y50
N120 X60 G40 G10
N130 X0 Y0
N140 M30
