# Of the scripts beside it, which it is read by: writes the tables that are asked for, NAME by the function NAME_table, and says
# of which commit and device they are. The script defines usage() and folder.

# write_tables "NAME ..." [ASKED...]: without any asked all are written.
write_tables() {
    known=$1
    shift
    case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
    esac
    # shellcheck disable=SC2086 # a list of words
    [ $# -gt 0 ] || set -- $known
    for table in "$@"; do
        case " $known " in
        *" $table "*) ;;
        *)
            usage >&2
            exit 64
            ;;
        esac
    done
    mkdir -p "$folder"
    MESA_SHADER_CACHE_DIR=${MESA_SHADER_CACHE_DIR:-$PWD/build/shader-cache}
    export MESA_SHADER_CACHE_DIR
    echo "Commit $(git describe --always --dirty); device $(build/bin/irradia devices | sed -n '2s/  \{2,\}/, /gp')"
    for table in "$@"; do
        echo
        "${table}_table"
    done
}
