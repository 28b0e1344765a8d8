import { dataOf, done, rest, urlOf } from '@/api/http';
import type { components } from '@/generated/api';

type Server = components['schemas'];

export type SharedRole = Server['SharedRole'];
export type Shares = Server['Shares'];
export type UserGroup = Server['Group'];

const inProject = (project_id: string) => ({ path: { project_id } });
const inGroup = (group_id: string) => ({ path: { group_id } });

/** The calls for sharing, for groups, and for the user's own data. */
export const accounts = {
  shares: (projectId: string) =>
    dataOf(rest.GET('/api/v1/projects/{project_id}/shares', { params: inProject(projectId) })),
  shareWithPerson: (projectId: string, name: string, role: SharedRole) =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/shares', {
        params: inProject(projectId),
        body: { name, role },
      }),
    ),
  unshareWithPerson: (project_id: string, username: string) =>
    done(
      rest.DELETE('/api/v1/projects/{project_id}/shares/people/{username}', {
        params: { path: { project_id, username } },
      }),
    ),
  makeOwner: (projectId: string, name: string) =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/transfer', { params: inProject(projectId), body: { name } }),
    ),
  shareWithGroup: (project_id: string, group_id: string, role: SharedRole) =>
    dataOf(
      rest.PUT('/api/v1/projects/{project_id}/shares/groups/{group_id}', {
        params: { path: { project_id, group_id } },
        body: { role },
      }),
    ),
  unshareWithGroup: (project_id: string, group_id: string) =>
    done(
      rest.DELETE('/api/v1/projects/{project_id}/shares/groups/{group_id}', {
        params: { path: { project_id, group_id } },
      }),
    ),
  makeLink: (projectId: string) =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/shares/links', { params: inProject(projectId), body: {} }),
    ),
  revokeLink: (project_id: string, link_id: string) =>
    done(
      rest.DELETE('/api/v1/projects/{project_id}/shares/links/{link_id}', {
        params: { path: { project_id, link_id } },
      }),
    ),

  groups: async () => (await dataOf(rest.GET('/api/v1/groups'))).items,
  createGroup: (name: string) => dataOf(rest.POST('/api/v1/groups', { body: { name } })),
  deleteGroup: (id: string) => done(rest.DELETE('/api/v1/groups/{group_id}', { params: inGroup(id) })),
  removeMember: (group_id: string, username: string) =>
    done(
      rest.DELETE('/api/v1/groups/{group_id}/members/{username}', {
        params: { path: { group_id, username } },
      }),
    ),
  invite: (id: string) =>
    dataOf(
      rest.POST('/api/v1/groups/{group_id}/invitations', {
        params: inGroup(id),
        body: { days: 14, max_uses: 40 },
      }),
    ),
  revokeInvitation: (invitation_id: string) =>
    done(rest.DELETE('/api/v1/invitations/{invitation_id}', { params: { path: { invitation_id } } })),

  usage: () => dataOf(rest.GET('/api/v1/me/usage')),
  deleteMe: (username: string) => done(rest.DELETE('/api/v1/me/data', { body: { username } })),
  dataUrl: urlOf('/me/data'),
};
