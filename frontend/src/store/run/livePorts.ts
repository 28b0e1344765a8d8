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
  /** A text is being typed; it is sent when it is finished, since half a number is another number. */
  readonly isTyping: boolean;
  /** By block and port. */
  readonly refused: Texts<PortRefusal>;
  /** Texts that the user wants to keep: they count as saved. By block and port. */
  readonly kept: Texts<string | null>;
  /** Up to this edit, the project differs from the program in ports only. */
  readonly portsOnlyUntil: number;
}

const initial: LivePorts = {
  program: null,
  isTyping: false,
  refused: {},
  kept: {},
  portsOnlyUntil: -1,
};

/** The ports of the program that runs, as far as only this page knows them. */
export const useLivePorts = create<LivePorts>(() => initial);

/** A program starts with these trees. */
export function beginProgram(program: LivePorts['program']): void {
  useLivePorts.setState({ ...initial, program });
}

export function setTyping(isTyping: boolean): void {
  if (useLivePorts.getState().isTyping !== isTyping) useLivePorts.setState({ isTyping });
}

/** Notes the refusal of a port; null: the program has its text. */
export function noteRefusal(key: LiveKey, port: string, refusal: PortRefusal | null): void {
  const { refused } = useLivePorts.getState();
  const { [port]: before, ...others } = refused[key] ?? {};
  if (before === undefined && refusal === null) return;
  const ports = refusal === null ? others : { ...others, [port]: refusal };
  useLivePorts.setState({ refused: { ...refused, [key]: ports } });
}

/** Takes a text for the saved one, until the next program. */
export function keepPort(key: LiveKey, port: string, value: string | null): void {
  const { kept } = useLivePorts.getState();
  useLivePorts.setState({ kept: { ...kept, [key]: { ...kept[key], [port]: value } } });
}
