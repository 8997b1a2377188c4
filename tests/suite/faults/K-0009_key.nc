; check: exit 1
; error K-0009 at 3:12
#OVERRIDE [FEED_FACT=300]
M30
