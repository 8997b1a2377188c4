; run: exit 0
; page 207101835 position preset and homing (#PSET, G74)
; end X0
; warning K-0111 at 8:1
N10 G90 G01 F6000 X20
N20 #PSET X100
N30 X110
G74 X1
N50 X0
N60 M30
