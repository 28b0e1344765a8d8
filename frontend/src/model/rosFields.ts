/** The ports of ROS blocks: which one holds the type, and those for fields of the interface. */

import type { PortDirection, PortSpec } from './ports';

export type InterfaceKind = 'action' | 'msg' | 'srv';

/** A field of an interface (REST `Field`). */
export interface InterfaceField {
  readonly port: string;
  readonly direction: 'input' | 'output';
  /** As in the catalogue of nodes; `any` for messages. */
  readonly type: string;
  /** As ROS writes it. */
  readonly ros: string;
}

const TYPE_PORTS: Readonly<Record<string, { readonly port: string; readonly kind: InterfaceKind }>> = {
  RosAction: { port: 'action_type', kind: 'action' },
  RosService: { port: 'service_type', kind: 'srv' },
  RosPublish: { port: 'topic_type', kind: 'msg' },
  RosSubscribe: { port: 'topic_type', kind: 'msg' },
};

/** Returns the port of a type of block that holds the name of an interface, and the kind; null for others. */
export const typePortOf = (type: string) => TYPE_PORTS[type] ?? null;

const NAME = /^([a-z]\w*)\/(?:(msg|srv|action)\/)?([A-Z]\w*)$/;

/** Returns the full name of an interface, `std_srvs/srv/Trigger`; null if it is not a name of this kind. */
export function fullName(text: string, kind: InterfaceKind): string | null {
  const match = NAME.exec(text.trim());
  if (!match || (match[2] !== undefined && match[2] !== kind)) return null;
  return `${match[1] ?? ''}/${kind}/${match[3] ?? ''}`;
}

/** The ports of ROS blocks that hold a name of ROS, each with an example. */
export const ROS_NAMES: Readonly<Record<string, string>> = {
  action_name: '/navigate_to_pose',
  service_name: '/reset',
  topic_name: '/cmd_vel',
  node_name: '/controller_server',
};

const ROS_NAME = /^(?:\/|~\/|~$)?(?:[A-Za-z_]\w*(?:\/[A-Za-z_]\w*)*)?$/;

/** Returns whether a text names a topic, service, action or node of ROS, like `is_ros_name` of the translator. */
export const isRosName = (name: string): boolean => !['', '/', '~/'].includes(name) && ROS_NAME.test(name);

/** Returns the path of a field as ROS writes it: `goal.pose` for `goal__pose`. */
export const fieldLabel = (port: string): string => port.replaceAll('__', '.');

/** Returns the last two parts of the path of a field: `position.x`. */
export const shortLabel = (port: string): string => port.split('__').slice(-2).join('.');

/** Returns the direction of a field in a block: a message is read by those that subscribe. */
export function directionIn(type: string, field: InterfaceField): PortDirection {
  return type === 'RosSubscribe' ? 'output' : field.direction;
}

/** Returns the direction of a field's port by its name, whatever is installed. */
export function directionOf(type: string, port: string): PortDirection {
  const part = port.split('__')[0] ?? '';
  const isOutput =
    ['result', 'feedback', 'response'].includes(part) || (part === 'message' && type === 'RosSubscribe');
  return isOutput ? 'output' : 'input';
}

/** Returns a field as a port of a block. */
export const fieldPort = (type: string, field: InterfaceField): PortSpec => ({
  name: field.port,
  direction: directionIn(type, field),
  type: field.type,
  default: null,
  required: false,
  description: `${fieldLabel(field.port)} · ${field.ros}`,
});

const FIRST_VALUES: Readonly<Record<string, string>> = { double: '0.0', int: '0', uint: '0', bool: 'false' };

/** Returns the value of a field's port that was just added: ROS's default, or a key named like the field. */
export function firstValue(type: string, field: InterfaceField): string {
  const key = `{${field.port.split('__').at(-1) ?? field.port}}`;
  if (directionIn(type, field) === 'output' || field.type === 'any') return key;
  return FIRST_VALUES[field.type] ?? '';
}
