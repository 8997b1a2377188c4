; check: exit 1
; error 20566 at 3:1
#COMMENT BEGIN X1
#COMMENT END
M30
