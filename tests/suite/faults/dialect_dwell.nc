; check: exit 1
; error 20925 at 4:5
; milliseconds of other dialects
G04 P500
M30
