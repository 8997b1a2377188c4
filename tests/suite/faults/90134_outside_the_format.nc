; check --set X,Y.kenngr.swe_pos=2000000000 --set X,Y.kenngr.swe_neg=-2000000000: exit 1
; error 90134 at 9:1
; error 90134 at 10:1
V.G.WZ_AKT.R=30000
G00 X0 Y0
G25
#TRC [STRETCH_FACTOR=9]
G41 G01 X10 Y0 F100000
X20000
X0 Y-10
G40 Y10
M30
