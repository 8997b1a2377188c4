; run: exit 0
; page 207850763 change of side at a reversal (#TRC [REVERSE=1])
; passes X0 Y2
; passes X20 Y2
; end X-10 Y5
N10 V.G.WZ_AKT.R=2
N20 #TRC [REVERSE=1]
N30 G01 F1000 X-5 Y0
N40 G41 X0 Y0
N50 X20
N60 G42 X0
N70 G40 X-10 Y5
N80 M30
