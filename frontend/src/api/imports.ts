import type { components } from '@/generated/api';
import { dataOf, rest } from './http';

type Server = components['schemas'];

/** What is imported into a project. */
export type PartKind = 'robot' | 'universe';

/** A file of an upload that may be a robot or a world. */
export type Candidate = Readonly<Server['ImportItem']>;

/** A line of a report; without a place, `file` is empty. */
export type ReportLine = Readonly<Server['ReportLine']>;

/** What an upload has. */
export type Inspection = Readonly<Server['Inspected']>;

/** The motion of a robot at a command of 1 m and of 360°. */
export type TestDrive = Readonly<Server['TestDrive']>;

/** The revision that an import made, and its report. */
export type ImportedPart = Readonly<Server['ImportedPart']>;

/** How an upload is imported. */
export interface ImportWish {
  readonly kind: PartKind;
  readonly main: string;
  readonly name: string;
  /** The arguments that differ from their defaults, by name. */
  readonly args: Readonly<Record<string, string>>;
  /** Whether the project runs with it. */
  readonly use: boolean;
  readonly replace: boolean;
  readonly simplify: boolean;
}

/** A file that is sent as the body itself: it may then be larger than any other request. */
export interface Upload {
  readonly name: string;
  readonly data: Blob;
}

const sent = ({ data }: Upload, signal: AbortSignal) => ({
  body: data,
  bodySerializer: (body?: Blob) => body,
  headers: { 'Content-Type': 'application/octet-stream' },
  signal,
});

/** The calls that import robots and worlds. */
export const imports = {
  inspect: (project_id: string, upload: Upload, signal: AbortSignal): Promise<Inspection> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/imports/inspect', {
        params: { path: { project_id }, query: { filename: upload.name } },
        ...sent(upload, signal),
      }),
    ),
  take: (
    project_id: string,
    upload: Upload,
    wish: ImportWish,
    signal: AbortSignal,
  ): Promise<ImportedPart> => {
    const { args, ...more } = wish;
    const arg = Object.entries(args).map(([name, value]) => `${name}:=${value}`);
    const query = { filename: upload.name, ...more, ...(arg.length > 0 ? { arg } : {}) };
    return dataOf(
      rest.POST('/api/v1/projects/{project_id}/imports', {
        params: { path: { project_id }, query },
        ...sent(upload, signal),
      }),
    );
  },
};
