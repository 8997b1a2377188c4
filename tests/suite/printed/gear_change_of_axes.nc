; run --set X.getriebe[3].nummer=4 --set Y.getriebe[1].nummer=8: exit 0
; page 206730251 gear change of axes (G112)
; end X0 Y0 Z0
N50 G112 X4 Y8
M30
