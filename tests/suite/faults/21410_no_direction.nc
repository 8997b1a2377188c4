; check: exit 1
; error 21410 at 3:1
#GET WCS POSLIMIT [VC1=0 VC2=0 VC3=0]
M30
