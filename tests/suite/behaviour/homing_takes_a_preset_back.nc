; run: exit 0
; end X0 Y-45 Z0
; warning K-0111 at 8:1
(207101835: the preset of X is gone, that of Y stays)
F6000 G01 X20 Y5
#PSET X100 Y50
X110
G74 X1
X0 Y0
M30
