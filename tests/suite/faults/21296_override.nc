; check: exit 1
; error 21296 at 3:12
#OVERRIDE [FEED_FACT=300]
M30
