; check --set X.kenngr.delay_filter_only_position=1: exit 0
; warning K-0075 at --set 1:1
M30
