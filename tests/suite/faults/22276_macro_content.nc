; check: exit 1
; error 22276 at 3:23
V.P.T = MACRO_CONTENT["A"]
M30
