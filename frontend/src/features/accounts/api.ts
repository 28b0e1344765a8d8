import { requestJson, urlOf } from '@/api/http';

export type SharedRole = 'viewer' | 'editor';

export interface Person {
  username: string;
  name: string;
}

export interface Shares {
  owner: Person;
  people: (Person & { role: SharedRole })[];
  groups: { id: string; name: string; role: SharedRole }[];
  links: { id: string; url: string; expires_at: string | null; created_at: string }[];
}

export interface Invitation {
  id: string;
  url: string;
  expires_at: string;
  uses: number;
  max_uses: number;
}

export interface UserGroup {
  id: string;
  name: string;
  owner: string;
  /** The user manages the group, and sees its members and invitations. */
  mine: boolean;
  members: Person[];
  invitations: Invitation[];
}

export interface Usage {
  projects: number;
  max_projects: number;
  bytes: number;
  max_bytes: number;
}

const part = encodeURIComponent;
const shares = (projectId: string) => `/projects/${part(projectId)}/shares`;

/** The calls of sharing, groups, and the user's own data. */
export const accounts = {
  shares: (projectId: string) => requestJson<Shares>(shares(projectId)),
  shareWithPerson: (projectId: string, name: string, role: SharedRole) =>
    requestJson<Shares>(shares(projectId), { method: 'POST', body: { name, role } }),
  unshareWithPerson: (projectId: string, username: string) =>
    requestJson<undefined>(`${shares(projectId)}/people/${part(username)}`, { method: 'DELETE' }),
  makeOwner: (projectId: string, name: string) =>
    requestJson<Shares>(`/projects/${part(projectId)}/transfer`, { method: 'POST', body: { name } }),
  shareWithGroup: (projectId: string, groupId: string, role: SharedRole) =>
    requestJson<Shares>(`${shares(projectId)}/groups/${groupId}`, { method: 'PUT', body: { role } }),
  unshareWithGroup: (projectId: string, groupId: string) =>
    requestJson<undefined>(`${shares(projectId)}/groups/${groupId}`, { method: 'DELETE' }),
  makeLink: (projectId: string) =>
    requestJson<Shares>(`${shares(projectId)}/links`, { method: 'POST', body: {} }),
  revokeLink: (projectId: string, linkId: string) =>
    requestJson<undefined>(`${shares(projectId)}/links/${linkId}`, { method: 'DELETE' }),

  groups: async () => (await requestJson<{ items: UserGroup[] }>('/groups')).items,
  createGroup: (name: string) => requestJson<UserGroup>('/groups', { method: 'POST', body: { name } }),
  deleteGroup: (id: string) => requestJson<undefined>(`/groups/${id}`, { method: 'DELETE' }),
  removeMember: (id: string, username: string) =>
    requestJson<undefined>(`/groups/${id}/members/${part(username)}`, { method: 'DELETE' }),
  invite: (id: string) =>
    requestJson<Invitation>(`/groups/${id}/invitations`, {
      method: 'POST',
      body: { days: 14, max_uses: 40 },
    }),
  revokeInvitation: (id: string) => requestJson<undefined>(`/invitations/${id}`, { method: 'DELETE' }),

  usage: () => requestJson<Usage>('/me/usage'),
  deleteMe: (username: string) =>
    requestJson<undefined>('/me/data', { method: 'DELETE', body: { username } }),
  dataUrl: urlOf('/me/data'),
};
