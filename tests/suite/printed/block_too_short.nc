; run: exit 0
; page 15556713099 polynomial contouring, a block that is too short for it
; warning 120216 at 7:1
; warning K-0111 at 5:16
#CONTOUR MODE [AUTO_DEV PATH_DEV=1 RELEVANT_PATH=0 RELEVANT_TRACK=0]
N10 G90 G01 X0 Y0 Z0 F6000
N20 G61 X99.999 Y0.001
N30 X100
N40 M30
