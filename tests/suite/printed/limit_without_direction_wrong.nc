; check: exit 1
; page 254562443 diagnosis 21410, wrong
; error 21410 at 4:1
#GET WCS POSLIMIT [VC1=0 VC2=0 VC3=0]
M30
