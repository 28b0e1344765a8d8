/* Notes which functions of the repository run, in a memory that all processes of a lane of tests share.

Python calls `evaluate` for each frame (PEP 523), in all threads, and without a place that a debugger or a
profiler needs. A code object is written down once in each epoch (each file of tests is one), by the hash of its
path and its first line; afterwards a call costs a comparison. The memory is a mapped file: a process that is
killed loses nothing, and one that closes all its files, or is sealed, still writes.

A *keeper* is a function whose result outlives it (a cache), or the body of a module. What runs inside of one
is written down a second time, as kept: it also belongs to later files whose tests find the result. */

#define Py_BUILD_CORE 1
#include <Python.h>
#include <internal/pycore_frame.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct { uint32_t path, line, epoch, process; } Record;
typedef struct { volatile uint32_t epoch; volatile uint32_t next; uint32_t capacity, processes; } Head;
typedef struct { uint32_t path, line, epoch; uint8_t is_keeper, is_kept; } Known;
enum { IS_START = 1u << 28, IS_BLIND = 1u << 29, IS_KEPT = 1u << 30, IS_FORK = 1u << 31, DEEPEST = 5000 };

static Head *head;
static Record *records;
static Py_ssize_t place = -1;
static uint32_t process;
static char root[4096];
static size_t root_length;
static uint64_t *keepers;
static size_t keepers_count;
static Known foreign;
static _Thread_local int depth, nested;

static void note(uint32_t path, uint32_t line, uint32_t epoch) {
    uint32_t at = __atomic_fetch_add(&head->next, 1, __ATOMIC_RELAXED);
    if (at >= head->capacity) { head->next = head->capacity + 1; return; }  /* a reader sees that it is full */
    records[at] = (Record){path, line, epoch, process};
}

/* Process ids are used again, so that each process gets its own number. */
static void started(void) {
    process = __atomic_add_fetch(&head->processes, 1, __ATOMIC_RELAXED);
    note((uint32_t)getpid(), IS_START, head->epoch);
}

static void forked(void) {
    uint32_t parent = process;
    started();
    note(parent, IS_FORK, head->epoch);
}

static uint32_t hash(const char *text, size_t length) {
    uint32_t found = 2166136261u;
    for (size_t i = 0; i < length; i++) found = (found ^ (uint8_t)text[i]) * 16777619u;
    return found;
}

static int is_keeper(uint32_t path, uint32_t line) {
    uint64_t sought = (uint64_t)path << 32 | line;
    size_t low = 0, high = keepers_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (keepers[middle] == sought) return 1;
        if (keepers[middle] < sought) low = middle + 1; else high = middle;
    }
    return 0;
}

static int is_made(const char *path) {
    return path[0] == '.' || strstr(path, "/.venv/") || strstr(path, "node_modules/") || !strncmp(path, "var/", 4);
}

static Known *first_sight(PyCodeObject *code) {
    Known *known = &foreign;
    Py_ssize_t length;
    const char *file = PyUnicode_AsUTF8AndSize(code->co_filename, &length);
    const char *name = PyUnicode_AsUTF8(code->co_name);
    if (!file || !name) { PyErr_Clear(); return known; }
    int is_module = !strcmp(name, "<module>");
    int is_function = (code->co_flags & CO_OPTIMIZED) && name[0] != '<';
    if ((is_module || is_function) && (size_t)length > root_length && !memcmp(file, root, root_length)
            && !is_made(file + root_length)) {
        Known *ours = malloc(sizeof *ours);
        if (ours) {
            uint32_t line = is_module ? 0 : (uint32_t)code->co_firstlineno;
            uint32_t path = hash(file + root_length, (size_t)length - root_length);
            *ours = (Known){path, line, 0, is_module || is_keeper(path, line), 0};
            known = ours;
        }
    }
    if (_PyCode_SetExtra((PyObject *)code, place, known)) {
        PyErr_Clear();
        if (known != &foreign) free(known);
        return &foreign;
    }
    return known;
}

static PyObject *evaluate(PyThreadState *state, _PyInterpreterFrame *frame, int is_throwing);

/* Evaluates a frame. Each one takes room of the C stack here, which it does not without us: a very deep
   recursion is left alone, and its epoch is marked as one that is not known. */
static PyObject *called(PyThreadState *state, _PyInterpreterFrame *frame, int is_throwing) {
    PyObject *result;
    if (nested < DEEPEST) {
        nested++;
        result = _PyEval_EvalFrameDefault(state, frame, is_throwing);
        nested--;
        return result;
    }
    note(0, IS_BLIND, head->epoch);
    _PyInterpreterState_SetEvalFrameFunc(state->interp, _PyEval_EvalFrameDefault);
    result = _PyEval_EvalFrameDefault(state, frame, is_throwing);
    _PyInterpreterState_SetEvalFrameFunc(state->interp, evaluate);
    return result;
}

static PyObject *evaluate(PyThreadState *state, _PyInterpreterFrame *frame, int is_throwing) {
    PyCodeObject *code = frame->f_code;
    Known *known = NULL;
    _PyCode_GetExtra((PyObject *)code, place, (void **)&known);
    if (!known) {
        PyObject *type, *value, *trace;  /* a frame may begin with an exception that is thrown into it */
        PyErr_Fetch(&type, &value, &trace);
        known = first_sight(code);
        PyErr_Restore(type, value, trace);
    }
    if (known == &foreign) return called(state, frame, is_throwing);
    if (known->epoch != head->epoch) {
        known->epoch = head->epoch;
        note(known->path, known->line, known->epoch);
    }
    if (depth && !known->is_kept) {
        known->is_kept = 1;
        note(known->path, known->line | IS_KEPT, known->epoch);
    }
    if (known->is_keeper && !known->is_kept) {
        known->is_kept = 1;
        note(known->path, known->line | IS_KEPT, known->epoch);
    }
    depth += known->is_keeper;
    PyObject *result = called(state, frame, is_throwing);
    depth -= known->is_keeper;
    return result;
}

static void forget(void *known) {
    if (known != &foreign) free(known);
}

static void *mapped(const char *path, int is_written, size_t *size) {
    struct stat facts;
    int file = open(path, (is_written ? O_RDWR : O_RDONLY) | O_CLOEXEC);
    void *found = MAP_FAILED;
    if (file >= 0 && !fstat(file, &facts) && facts.st_size > 0) {
        *size = (size_t)facts.st_size;
        found = mmap(NULL, *size, is_written ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, file, 0);
    }
    if (file >= 0) close(file);
    return found == MAP_FAILED ? NULL : found;
}

/* begin(root, records, keepers): notes from now on; false where a file cannot be mapped. */
static PyObject *begin(PyObject *module, PyObject *arguments) {
    const char *below, *lane, *kept;
    size_t size = 0;
    if (!PyArg_ParseTuple(arguments, "sss", &below, &lane, &kept)) return NULL;
    if (strlen(below) + 2 > sizeof root) Py_RETURN_FALSE;
    Head *found = mapped(lane, 1, &size);
    if (!found || size < sizeof(Head) || size < sizeof(Head) + sizeof(Record) * found->capacity) Py_RETURN_FALSE;
    if ((keepers = mapped(kept, 0, &size))) keepers_count = size / sizeof *keepers;
    strcpy(root, below);
    root_length = strlen(root);
    if (place < 0 && (place = _PyEval_RequestCodeExtraIndex(forget)) < 0) Py_RETURN_FALSE;
    int is_first = !head;  /* a measured test that measures begins in another lane */
    head = found;
    records = (Record *)(found + 1);
    started();
    if (is_first) pthread_atfork(NULL, NULL, forked);
    _PyInterpreterState_SetEvalFrameFunc(PyInterpreterState_Get(), evaluate);
    Py_RETURN_TRUE;
}

/* is_noting(): whether frames still come here; a debugger may have taken the place. */
static PyObject *is_noting(PyObject *module, PyObject *arguments) {
    return PyBool_FromLong(head && _PyInterpreterState_GetEvalFrameFunc(PyInterpreterState_Get()) == evaluate);
}

static PyMethodDef functions[] = {
    {"begin", begin, METH_VARARGS, NULL},
    {"is_noting", is_noting, METH_NOARGS, NULL},
    {NULL, NULL, 0, NULL},
};
static struct PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "_bt_studio_executed", NULL, -1, functions, NULL, NULL, NULL, NULL
};
PyMODINIT_FUNC PyInit__bt_studio_executed(void) { return PyModule_Create(&definition); }
