; check: exit 1
; error 21601 at 3:13
#CS SELECT [WCS]
M30
