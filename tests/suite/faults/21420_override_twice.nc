; check: exit 1
; error 21420 at 3:26
#OVERRIDE [FEED_FACT=50, FEED_FACT=60]
M30
