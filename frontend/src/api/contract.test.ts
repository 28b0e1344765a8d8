import { expectTypeOf, it } from 'vitest';
import type { components } from '@/generated/api';
import type {
  ActionModel,
  AppBundle,
  ChangesResult,
  Conflict,
  Diagnostic,
  Me,
  ProjectFile,
  ProjectSummary,
  SessionInfo,
  TemplateInfo,
} from './types';

type Server = components['schemas'];

/** What the server sends (`npm run generate`, from its OpenAPI) can be read as what the page expects. */
it('reads what the server sends', () => {
  expectTypeOf<Server['Diagnostic']>().toExtend<Diagnostic>();
  expectTypeOf<Server['Action']>().toExtend<ActionModel>();
  expectTypeOf<Server['File']>().toExtend<ProjectFile>();
  expectTypeOf<Server['ProjectSummary']>().toExtend<ProjectSummary>();
  expectTypeOf<Server['ChangesDone']>().toExtend<ChangesResult>();
  expectTypeOf<Server['Conflict']>().toExtend<Conflict>();
  expectTypeOf<Server['App']>().toExtend<AppBundle>();
  expectTypeOf<Server['Session']>().toExtend<SessionInfo>();
  expectTypeOf<Server['Template']>().toExtend<TemplateInfo>();
  expectTypeOf<Server['Me']>().toExtend<Me>();
});
