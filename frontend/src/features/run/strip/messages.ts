import type { Diagnostic } from '@/api/types';
import type { Fault, Finished, LaunchNode } from '@/generated/messages';
import { t } from '@/i18n';
import type { Connection } from '@/store/session/connectionStates';
import { isOfLaunchNode } from '@/store/session/reduce';
import type { LaunchFailure } from '@/store/run/store';
import type { BlockPlace } from '@/store/problems/open';
import { useProjectStore } from '@/store/project';
import { ownProblemOf } from '@/store/project/problems';
import { findingText } from '@/ui/findingText';
import { problemText } from '@/ui/hooks/useProblemText';

export type MessageKind =
  'connection' | 'silence' | 'failure' | 'fault' | 'finished' | 'node' | 'viewer' | 'world' | 'restart';

/** The kinds of messages, the most important first. */
export const PRIORITY: readonly MessageKind[] = [
  'connection',
  'silence',
  'failure',
  'fault',
  'finished',
  'viewer',
  'restart',
  'node',
  'world',
];

export type MessageLink = { file: string; line: number } | BlockPlace;

/** One message of the strip. */
export interface StripMessage {
  id: string;
  kind: MessageKind;
  tone: 'error' | 'warning' | 'success' | 'quiet';
  /** The i18n key in `run`; `values` fill it in. */
  titleKey: string;
  values: Record<string, string>;
  text: string;
  hint: string;
  link: MessageLink | null;
  /** The command that is the next step. Its label is `commandKey`, or the command's own. */
  command?: string;
  commandKey?: string;
  /** Another next step, which is offered before it. */
  first?: { command: string; labelKey: string };
  canDismiss: boolean;
  /** The fault that the message reports. */
  fault?: Fault;
}

export interface Situation {
  connection: Connection;
  connectionMessage: string;
  /** The number of seconds since the executor's last answer. */
  silentS: number;
  /** The reason for the current rung, if no command led to it. */
  executorReason: string;
  faults: readonly Fault[];
  launchNodes: readonly LaunchNode[];
  failure: LaunchFailure | null;
  /** The end of the last run. */
  finished: Finished | null;
  /** Set if this page only views the session. */
  viewer: { wasTakenOver: boolean } | null;
  canRestart: boolean;
  /** Whether the world runs without a program. */
  worldRuns: boolean;
}

/** The largest number of listed faults. */
const MAX_FAULTS = 5;

/** Returns all messages of a run, the most important first. */
export function messagesFor(situation: Situation): StripMessage[] {
  const { connection, connectionMessage, silentS, failure, viewer, canRestart, worldRuns } = situation;
  const isLost = connection === 'reconnecting' || connection === 'lost';
  const messages = [
    isLost ? connectionBanner(connection, connectionMessage) : null,
    !isLost && silentS > 0 ? silenceBanner(silentS) : null,
    failure ? failureBanner(failure) : null,
    ...faultBanners(situation),
    endBanner(situation),
    viewer ? viewerNotice(viewer.wasTakenOver) : null,
    canRestart ? restartOffer() : null,
    worldRuns ? worldNotice() : null,
  ].filter((message) => message !== null);
  return messages.sort((a, b) => PRIORITY.indexOf(a.kind) - PRIORITY.indexOf(b.kind));
}

/** Returns a message for each of the last faults, the newest first; equal faults are listed once. */
function faultBanners({ faults, launchNodes }: Situation): StripMessage[] {
  const byText = new Map([...faults].reverse().map((fault) => [fault.message, fault]));
  return [...byText.values()]
    .slice(0, MAX_FAULTS)
    .map((fault) => faultBanner(fault, isOfLaunchNode(fault, launchNodes)));
}

/** Returns a message about the end of the run, unless a fault or a failure already reports it. */
function endBanner({
  executorReason,
  faults,
  launchNodes,
  failure,
  finished,
}: Situation): StripMessage | null {
  const isTold = failure !== null || faults.some((fault) => !isOfLaunchNode(fault, launchNodes));
  if (!executorReason || isTold) return null;
  return finished?.reason === 'root_finished' ? finishedBanner(finished) : reasonBanner(executorReason);
}

function viewerNotice(wasTakenOver: boolean): StripMessage {
  return {
    ...PLAIN,
    id: 'viewer',
    kind: 'viewer',
    tone: 'quiet',
    titleKey: wasTakenOver ? 'takenOver' : 'runBlocker.viewer',
    hint: t('run:takeOverHelp'),
    command: 'run.takeOver',
    commandKey: wasTakenOver ? 'takeBack' : 'takeOver',
    canDismiss: true,
  };
}

function worldNotice(): StripMessage {
  return {
    ...PLAIN,
    id: 'world',
    kind: 'world',
    tone: 'quiet',
    titleKey: 'worldRuns',
    command: 'run.stop',
    commandKey: 'pauseWorld',
  };
}

function restartOffer(): StripMessage {
  return {
    ...PLAIN,
    id: 'restart',
    kind: 'restart',
    tone: 'quiet',
    titleKey: 'changedOffer',
    hint: t('run:restartOfferHelp'),
    first: { command: 'run.apply', labelKey: 'command.apply' },
    command: 'run.restart',
    commandKey: 'restartOffer',
    canDismiss: true,
  };
}

const PLAIN = { values: {}, text: '', hint: '', link: null, canDismiss: false } as const;

/** The first sentence of the executor's message, which the title already says in the user's language. */
const ENDED = /^The tree ended with \w+\.\s*/;

function finishedBanner({ status, message, node_id, tree_id, node_path }: Finished): StripMessage {
  return {
    ...PLAIN,
    id: 'finished',
    kind: 'finished',
    tone: status === 'FAILURE' ? 'error' : status === 'SUCCESS' ? 'success' : 'warning',
    titleKey: `banner.finished.${status}`,
    values: { node: nameIn(node_path) },
    text: message.replace(ENDED, ''),
    canDismiss: true,
    link: status === 'FAILURE' && node_id ? { tree: tree_id, node: node_id } : null,
  };
}

/** Returns the last name in a path, without the number that the engine adds for unnamed nodes. */
const nameIn = (path: string) => (path.split('/').at(-1) ?? '').replace(/::\d+$/, '');

function reasonBanner(reason: string): StripMessage {
  return {
    ...PLAIN,
    id: 'ended',
    kind: 'finished',
    tone: 'error',
    titleKey: 'banner.ended',
    text: reason,
    canDismiss: true,
  };
}

function connectionBanner(connection: 'reconnecting' | 'lost', message: string): StripMessage {
  return {
    ...PLAIN,
    id: 'connection',
    kind: 'connection',
    tone: connection === 'lost' ? 'error' : 'warning',
    titleKey: `banner.${connection}`,
    text: message,
    ...(connection === 'lost' ? { command: 'run.run', canDismiss: true } : {}),
  };
}

function silenceBanner(silentS: number): StripMessage {
  return {
    ...PLAIN,
    id: 'silence',
    kind: 'silence',
    tone: 'warning',
    titleKey: 'banner.silent',
    values: { seconds: String(silentS) },
    hint: t('run:banner.silentHelp'),
  };
}

function faultBanner(fault: Fault, isNode: boolean): StripMessage {
  const where = fault.file && fault.line > 0;
  const node = nameIn(fault.node_path);
  return {
    id: `fault ${fault.message}`,
    kind: isNode ? 'node' : 'fault',
    tone: 'error',
    titleKey: where ? 'banner.faultAt' : `banner.${node ? 'faultOf' : 'fault'}.${fault.kind}`,
    values: { file: fault.file, line: String(fault.line), node },
    text: fault.message,
    hint: fault.hint,
    link: where
      ? { file: fault.file, line: fault.line }
      : fault.node_id
        ? { tree: fault.tree_id, node: fault.node_id }
        : null,
    canDismiss: true,
    fault,
  };
}

function failureBanner(failure: LaunchFailure): StripMessage {
  const errors = failure.diagnostics.filter((item) => item.severity === 'error');
  const first = errors[0];
  const words = first ? wordsOf(first) : { message: failure.message, hint: failure.hint };
  return {
    id: 'failure',
    kind: 'failure',
    tone: 'error',
    titleKey:
      failure.code === 'command_refused'
        ? 'banner.refused'
        : `banner.${failure.isChange ? 'unchanged' : 'failed'}.${failure.stage}`,
    values: { count: String(errors.length) },
    text: words.message,
    hint: words.hint,
    link: linkToNode(first) ?? linkToLine(first) ?? linkToText(failure.message),
    ...(failure.code === 'own_places_taken' ? { command: 'run.mine' } : {}),
    canDismiss: true,
  };
}

/**
 * Returns the place at the beginning of a simulator's message, such as `robots/mine/robot.yaml:10:25: …`;
 * null if there is none.
 */
function linkToText(message: string): MessageLink | null {
  const [, file = '', line = ''] = /^([\w./-]+\.\w+):(\d+):(?:\d+:)? /.exec(message) ?? [];
  return file === '' ? null : { file, line: Number(line) };
}

function linkToNode(item: Diagnostic | undefined): MessageLink | null {
  if (!item?.tree || !item.node) return null;
  return { tree: item.tree, node: item.node, ...(item.port ? { port: item.port } : {}) };
}

const linkToLine = (item: Diagnostic | undefined): MessageLink | null =>
  item?.file && item.line ? { file: item.file, line: item.line } : null;

/** Returns the words that the list of problems has for a finding. */
function wordsOf(item: Diagnostic): { message: string; hint: string } {
  const { diagrams, vocabulary } = useProjectStore.getState();
  const own = ownProblemOf(item, diagrams, vocabulary);
  return own ? problemText(own) : findingText(item);
}
