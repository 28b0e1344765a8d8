import { useProjectStore } from '../index';
import { actionPath } from '../state';

export type ActionKind = 'Action' | 'Condition' | 'Control' | 'Decorator';

const DECLARED = (port: string): string => `        "${port}": Port(str, description="Say what it is."),`;

/**
 * Returns the source of a control node or decorator: complete, runnable, and short enough to be read at once.
 */
function ownNodeSource(name: string, kind: 'Control' | 'Decorator', ports: readonly string[]): string {
  const base = `${kind}Node`;
  const names = [base, ...(ports.length === 0 ? [] : ['Port']), 'Status'].join(', ');
  const declared =
    ports.length === 0 ? '' : `    INPUT_PORTS = {\n${ports.map(DECLARED).join('\n')}\n    }\n\n`;
  const rule =
    kind === 'Control'
      ? `    """Ticks its children in order until one succeeds."""

${declared}    def update(self):
        for index in range(self.child_count):
            status = self.tick_child(index)
            if status is Status.RUNNING:
                return Status.RUNNING
            if status is Status.SUCCESS:
                self.halt_children()
                return Status.SUCCESS
        self.halt_children()
        return Status.FAILURE
`
      : `    """Succeeds when its child fails, and passes on all else."""

${declared}    def update(self):
        status = self.tick_child()
        return Status.SUCCESS if status is Status.FAILURE else status
`;
  return `from tree_gardener import ${names}\n\n\nclass ${name}(${base}):\n${rule}`;
}

/** Returns the source of a new action: complete, runnable and short. */
export function actionSource(
  name: string,
  kind: ActionKind,
  /** The ports that one of its blocks already sets. */
  ports: readonly string[] = [],
): string {
  if (kind === 'Control' || kind === 'Decorator') return ownNodeSource(name, kind, ports);
  const declares = kind === 'Condition' ? '\n    NODE_KIND = "Condition"\n' : '';
  const says =
    kind === 'Condition'
      ? 'Succeeds if what it is named after is so.'
      : 'Succeeds when what it is named after is done.';
  const declared =
    ports.length === 0
      ? `        "message": Port(str, default="${name}", description="What to print."),`
      : ports.map(DECLARED).join('\n');
  const printed = `get_input(self, "${ports[0] ?? 'message'}")`;
  return `import py_trees
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class ${name}(py_trees.behaviour.Behaviour):
    """${says}"""
${declares}
    INPUT_PORTS = {
${declared}
    }

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]  # make publishers and subscriptions with it

    def initialise(self):
        """Called when the node starts, before its first update."""

    def update(self):
        print(${printed})
        return py_trees.common.Status.SUCCESS

    def terminate(self, new_status):
        """Called when the node is done or halted: stop what it started."""
`;
}

/** Adds an action to the project, so that it can be placed and edited at once. */
export function createAction(name: string, kind: ActionKind = 'Action', ports: readonly string[] = []): void {
  const { files, actions, addFile, setChecked, diagnostics } = useProjectStore.getState();
  if (actionPath(name) in files) return;
  addFile(actionPath(name), actionSource(name, kind, ports));
  const isOwnNode = kind === 'Control' || kind === 'Decorator';
  const message = {
    name: 'message',
    direction: 'input',
    type: 'str',
    default: name,
    required: false,
  } as const;
  // Until the server reads the class after a save, the template's declarations apply.
  setChecked({
    diagnostics,
    actions: [
      ...actions,
      {
        name,
        path: actionPath(name),
        doc: '',
        kind,
        open: isOwnNode && ports.length === 0,
        ports:
          ports.length === 0
            ? isOwnNode
              ? []
              : [message]
            : ports.map((port) => ({ name: port, direction: 'input', type: 'string' })),
      },
    ],
  });
}
