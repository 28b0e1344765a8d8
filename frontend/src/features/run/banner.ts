import type { Fault, Finished } from '@/generated/messages';
import { t } from '@/i18n';
import type { Connection } from '@/store/session/connectionStates';
import type { LaunchFailure } from '@/store/run/store';
import { findingText } from '@/ui/findingText';

/** The content of the banner: the most urgent problem. */
export interface BannerContent {
  kind: 'connection' | 'silence' | 'fault' | 'failure' | 'finished';
  tone: 'error' | 'warning' | 'success';
  /** The i18n key in `run:banner`, and its values. */
  titleKey: string;
  values: Record<string, string>;
  text: string;
  hint: string;
  link: { file: string; line: number } | { tree: string; node: string } | null;
}

interface Situation {
  connection: Connection;
  connectionMessage: string;
  /** The number of seconds since the executor's last answer. */
  silentS: number;
  /** The reason of the present rung, if no command led to it. */
  executorReason: string;
  faults: readonly Fault[];
  failure: LaunchFailure | null;
  /** How the last run ended. */
  finished: Finished | null;
}

/** The most urgent problem: a lost connection, a silent executor, the last fault, then a refused command. */
export function bannerFor(situation: Situation): BannerContent | null {
  const { connection, connectionMessage, silentS, executorReason, faults, failure, finished } = situation;
  if (connection === 'reconnecting' || connection === 'lost')
    return connectionBanner(connection, connectionMessage);
  if (silentS > 0) return silenceBanner(silentS);
  if (failure) return failureBanner(failure);
  const fault = faults.at(-1);
  if (fault) return faultBanner(fault);
  if (!executorReason) return null;
  return finished?.reason === 'root_finished' ? finishedBanner(finished) : reasonBanner(executorReason);
}

/** The first sentence of the executor, which the title says in the user's language. */
const ENDED = /^The tree ended with \w+\.\s*/;

function finishedBanner({ status, message, node_id, tree_id, node_path }: Finished): BannerContent {
  return {
    kind: 'finished',
    tone: status === 'FAILURE' ? 'error' : status === 'SUCCESS' ? 'success' : 'warning',
    titleKey: `banner.finished.${status}`,
    values: { node: nameIn(node_path) },
    text: message.replace(ENDED, ''),
    hint: '',
    link: status === 'FAILURE' && node_id ? { tree: tree_id, node: node_id } : null,
  };
}

/** The last name of a path, without the number that the engine gives to unnamed nodes. */
const nameIn = (path: string) => (path.split('/').at(-1) ?? '').replace(/::\d+$/, '');

function reasonBanner(reason: string): BannerContent {
  return {
    kind: 'fault',
    tone: 'error',
    titleKey: 'banner.ended',
    values: {},
    text: reason,
    hint: '',
    link: null,
  };
}

function connectionBanner(connection: 'reconnecting' | 'lost', message: string): BannerContent {
  return {
    kind: 'connection',
    tone: connection === 'lost' ? 'error' : 'warning',
    titleKey: `banner.${connection}`,
    values: {},
    text: message,
    hint: '',
    link: null,
  };
}

function silenceBanner(silentS: number): BannerContent {
  return {
    kind: 'silence',
    tone: 'warning',
    titleKey: 'banner.silent',
    values: { seconds: String(silentS) },
    text: '',
    hint: t('run:banner.silentHelp'),
    link: null,
  };
}

function faultBanner(fault: Fault): BannerContent {
  const where = fault.file && fault.line > 0;
  const node = nameIn(fault.node_path);
  return {
    kind: 'fault',
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
  };
}

function failureBanner(failure: LaunchFailure): BannerContent {
  const errors = failure.diagnostics.filter((item) => item.severity === 'error');
  const first = errors[0];
  const words = first ? findingText(first) : { message: failure.message, hint: failure.hint };
  return {
    kind: 'failure',
    tone: 'error',
    titleKey: failure.code === 'command_refused' ? 'banner.refused' : `banner.failed.${failure.stage}`,
    values: { count: String(errors.length) },
    text: words.message,
    hint: words.hint,
    link:
      first?.file && first.line
        ? { file: first.file, line: first.line }
        : (linkToNode(first) ?? linkToText(failure.message)),
  };
}

/** The place at the beginning of a message of the simulator: `robots/mine/robot.yaml:10:25: …`. */
function linkToText(message: string): BannerContent['link'] {
  const [, file = '', line = ''] = /^([\w./-]+\.\w+):(\d+):(?:\d+:)? /.exec(message) ?? [];
  return file === '' ? null : { file, line: Number(line) };
}

function linkToNode(item: { tree?: string | null; node?: string | null } | undefined): BannerContent['link'] {
  return item?.tree && item.node ? { tree: item.tree, node: item.node } : null;
}
