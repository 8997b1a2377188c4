; run --set X.lr_param.dyn_monitoring_v_err=1 --set X.getriebe[0].kv=15000: exit 1
; error 70382 at 3:1
N10 G00 X400
M30
