; run: exit 0
; A square whose corners are faster than splines of this tolerance: it takes as long as without #HSC
; note K-0146 at 7:1
G00 X0 Y0
G01 F15000
#HSC ON [BSPLINE PATH_DEV=0.05]
X5
Y5
X0
Y0
#HSC OFF
M30
