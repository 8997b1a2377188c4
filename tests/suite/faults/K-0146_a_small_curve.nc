; run: exit 0
; note K-0146 at 6:1
; at F20000 and 135 degrees a curve of 0.005 mm takes longer than the corner; a wider one at the flat corner after it does not
#CONTOUR MODE [DEV PATH_DEV=0.005]
G261 F20000
X40
X10 Y30
#CONTOUR MODE [DEV PATH_DEV=0.5]
X0 Y45
X-10 Y55
G260
M30
