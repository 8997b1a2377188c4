; check: exit 1
; error 20825 at 5:1
#CS ON [1][1,2,3]
G00 X0 Y0 Z0
#CS ON [1][10,20,30]
M30
