import { create } from 'zustand';
import type { Diagram } from '@/model/diagram';
import type { LiveKey } from '@/store/project/live';

type Texts<T> = Readonly<Record<LiveKey, Readonly<Record<string, T>>>>;

/** A text of a port that the running program did not take. */
export interface PortRefusal {
  readonly value: string | null;
  /** The text that the program keeps. */
  readonly before: string | null;
  readonly code: string;
  readonly message: string;
}

interface LivePorts {
  /** The trees with the ports that the program was given; null before it is known. */
  readonly program: Readonly<Record<string, Diagram>> | null;
  /**
   * Whether the user is typing a text. It is sent when it is complete, since half a number is a different
   * number.
   */
  readonly isTyping: boolean;
  /** The refused texts, by block and port. */
  readonly refused: Texts<PortRefusal>;
  /** Texts that the user wants to keep, by block and port: they count as saved. */
  readonly kept: Texts<string | null>;
  /** The edit up to which the project differs from the program only in ports. */
  readonly portsOnlyUntil: number;
}

const initial: LivePorts = {
  program: null,
  isTyping: false,
  refused: {},
  kept: {},
  portsOnlyUntil: -1,
};

/** The data on the running program's ports that only this page has. */
export const useLivePorts = create<LivePorts>(() => initial);

/** Records that a program starts with these trees. */
export function beginProgram(program: LivePorts['program']): void {
  useLivePorts.setState({ ...initial, program });
}

export function setTyping(isTyping: boolean): void {
  if (useLivePorts.getState().isTyping !== isTyping) useLivePorts.setState({ isTyping });
}

/** Records the refusal of a port's text; null means that the program accepted it. */
export function noteRefusal(key: LiveKey, port: string, refusal: PortRefusal | null): void {
  const { refused } = useLivePorts.getState();
  const { [port]: before, ...others } = refused[key] ?? {};
  if (before === undefined && refusal === null) return;
  const ports = refusal === null ? others : { ...others, [port]: refusal };
  useLivePorts.setState({ refused: { ...refused, [key]: ports } });
}

/** Makes a text count as saved until the next program starts. */
export function keepPort(key: LiveKey, port: string, value: string | null): void {
  const { kept } = useLivePorts.getState();
  useLivePorts.setState({ kept: { ...kept, [key]: { ...kept[key], [port]: value } } });
}
