import { useProjectStore } from '../index';
import { actionPath } from '../state';

export type ActionKind = 'Action' | 'Condition';

/** The source of a new action: complete, runnable, and short enough to be read at once. */
export function actionSource(
  name: string,
  kind: ActionKind,
  /** Those that a block of it sets already. */
  ports: readonly string[] = [],
): string {
  const declares = kind === 'Condition' ? '\n    NODE_KIND = "Condition"\n' : '';
  const says =
    kind === 'Condition'
      ? 'Succeeds if what it is named after is so.'
      : 'Succeeds when what it is named after is done.';
  const declared =
    ports.length === 0
      ? `        "message": Port(str, default="${name}", description="What to print."),`
      : ports.map((port) => `        "${port}": Port(str, description="Say what it is."),`).join('\n');
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
  // The server reads the class after the save; until then this says what the template declares.
  setChecked({
    diagnostics,
    actions: [
      ...actions,
      {
        name,
        path: actionPath(name),
        doc: '',
        kind,
        open: false,
        ports:
          ports.length === 0
            ? [{ name: 'message', direction: 'input', type: 'str', default: name, required: false }]
            : ports.map((port) => ({ name: port, direction: 'input', type: 'string' })),
      },
    ],
  });
}
