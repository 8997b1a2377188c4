; run: exit 0
; end X0 Y0 Z0
; warning K-0111 at 7:1
F6000 G01 X20 Y5
#PSET X100 Y50
X110
G74
X0 Y0
M30
