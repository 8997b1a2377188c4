; check: exit 1
; page 252682379 diagnosis 20825, a system defined while it is active
; error 20825 at 6:1
#CS ON[1][1,2,3,0,0,0]
X0 Y0 Z0 G01 F6000
#CS ON[1][10,20,30,0,0,0]
M30
