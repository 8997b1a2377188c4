; run --set X.getriebe[0].kv=500000 --set X.lr_param.dyn_monitoring_v_err=0: exit 1
; error K-0035 at 3:1
N10 G01 X100 F6000
M30
