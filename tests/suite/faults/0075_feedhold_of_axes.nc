; check --set X.kenngr.feedhold_deceleration_mode=FEEDHOLD_DECELERATION: exit 0
; warning K-0075 at --set 1:1
M30
